// Units and devices: the list of each, and the page of each one.
import { html } from 'lit';
import { customElement } from 'lit/decorators.js';
import { keyed } from 'lit/directives/keyed.js';
import './component_list';
import './component_page';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';

abstract class ComponentsView extends ViewBase {
  static override styles = viewStyles;
  protected abstract readonly kind: 'unit' | 'device';

  protected override render(): unknown {
    const name = this.path[0];
    if (name === undefined || name === '') {
      return html`<flexrf-component-list .core=${this.core} .host=${this.host} kind=${this.kind}></flexrf-component-list>`;
    }
    const component = this.core.model.components.get(name);
    if (component?.kind !== this.kind) {
      return html`<h2>${name}</h2><p>There is no ${this.kind} of this name. <a href="#/${this.kind}s">All ${this.kind}s</a></p>`;
    }
    // A page for each: what belongs to one component does not stay when another is shown.
    return keyed(name, html`<flexrf-component-page .core=${this.core} .host=${this.host} .component=${component}></flexrf-component-page>`);
  }
}

@customElement('flexrf-units')
export class UnitsView extends ComponentsView {
  protected override readonly kind = 'unit';
}

@customElement('flexrf-devices')
export class DevicesView extends ComponentsView {
  protected override readonly kind = 'device';
}
