#include "config-gen/emit/descriptor_panel.hpp"

namespace flexrf::config_gen {
namespace {

using Json = nlohmann::ordered_json;

Json roles_json(const PanelWidget::Roles& roles) {
  Json json = Json::object();
  for (const auto& [role, name] : roles) json[role] = name;
  return json;
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
