#include "config-gen/emit/descriptor_panel.hpp"

namespace flexrf::config_gen {
namespace {

using Json = nlohmann::ordered_json;

Json roles_json(const PanelWidget::Roles& roles) {
  Json json = Json::object();
  for (const auto& [role, name] : roles) json[role] = name;
  return json;
}

Json things_json(const PanelThings& things) {
  Json json = Json::object();
  json["name"] = things.name;
  if (!things.label.empty()) json["label"] = things.label;
  json["shown"] = things.shown;
  json["slots"] = things.slots;
  if (!things.list.empty()) json["list"] = things.list;
  if (!things.count.empty()) json["count"] = things.count;
  if (things.empty) {
    Json& empty = json["empty"];
    empty["field"] = things.empty->first;
    std::visit([&empty](const auto& value) { empty["value"] = value; }, things.empty->second);
  }
  json["text"] = things.text;
  if (!things.certain.empty()) json["certain"] = things.certain;
  if (!things.doubtful.empty()) json["doubtful"] = things.doubtful;
  return json;
}

Json overlay_json(const PanelOverlay& overlay) {
  Json json = things_json(overlay.things);
  json["rectangle"] = overlay.rectangle;
  if (!overlay.sort.empty()) json["class"] = overlay.sort;
  if (!overlay.classes.empty()) json["classes"] = overlay.classes;
  if (!overlay.weight.empty()) json["weight"] = overlay.weight;
  if (!overlay.time.empty())
    json["time"] = {{"of", overlay.time_of_slot ? "slot" : "thing"}, {"field", overlay.time}};
  return json;
}

Json bodies_json(const PanelBodies& bodies) {
  Json json = things_json(bodies.things);
  json["position"] = bodies.position;
  if (!bodies.angle.empty()) json["angle"] = bodies.angle;
  json["kind"] = bodies.kind;
  Json& kinds = json["kinds"] = Json::array();
  for (const PanelBodyKind& kind : bodies.kinds) {
    Json one = Json::object();
    one["name"] = kind.name;
    if (kind.value)
      one["value"] = *kind.value;
    else
      one["value"] = kind.name;
    if (kind.outline.empty())
      std::visit([&one](const auto& radius) { one["radius"] = radius; }, kind.radius);
    else
      one["outline"] = kind.outline;
    one["height"] = kind.height;
    one["colour"] = kind.colour;
    kinds.push_back(std::move(one));
  }
  return json;
}

Json frame_json(const PanelFrame& frame) {
  Json json = Json::object();
  json["name"] = frame.name;
  if (!frame.label.empty()) json["label"] = frame.label;
  json["shown"] = frame.shown;
  if (!frame.slot.empty()) json["slot"] = frame.slot;
  if (!frame.link.empty()) json["link"] = frame.link;
  if (frame.mount)
    json["mount"] = {{"position", frame.mount->position}, {"orientation", frame.mount->orientation}};
  if (const auto& frustum = frame.frustum)
    json["frustum"] = {{"width", frustum->width},
                       {"height", frustum->height},
                       {"focal_length", frustum->focal_length},
                       {"depth", frustum->depth}};
  return json;
}

template <class Layer>
void add_layers(Json& json, const char* key, const std::vector<Layer>& layers, Json (*make)(const Layer&)) {
  if (layers.empty()) return;
  Json& list = json[key] = Json::array();
  for (const Layer& layer : layers) list.push_back(make(layer));
}

Json widget_json(const Model& model, const PanelWidget& widget) {
  Json json = {{"name", widget.name}, {"kind", widget.kind}, {"custom", widget.custom}};
  if (!widget.label.empty()) json["label"] = widget.label;
  json["place"] = widget.place;
  json["slots"] = roles_json(widget.slots);
  json["parameters"] = roles_json(widget.parameters);
  if (widget.device) json["device"] = model.devices[*widget.device].name;
  Json options = Json::object();
  for (const auto& [name, option] : widget.options)
    std::visit([&options, &key = name](const auto& value) { options[key] = value; }, option);
  json["options"] = std::move(options);
  add_layers(json, "overlays", widget.overlays, overlay_json);
  add_layers(json, "bodies", widget.bodies, bodies_json);
  add_layers(json, "frames", widget.frames, frame_json);
  if (!widget.base.empty()) json["base"] = widget.base;
  if (!widget.summary.empty()) json["summary"] = widget.summary;
  return json;
}

}  // namespace

nlohmann::ordered_json widgets_json(const Model& model) {
  Json list = Json::array();
  for (const PanelWidget& widget : model.panel.widgets) list.push_back(widget_json(model, widget));
  return list;
}

}  // namespace flexrf::config_gen
