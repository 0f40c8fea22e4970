// A menu entry of the application's own: the parameters that name it in the tables.
import { css, html } from 'lit';
import { customElement } from 'lit/decorators.js';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';
import './widget_place';

@customElement('flexrf-menu')
export class Menu extends ViewBase {
  static override styles = [
    viewStyles,
    css`
      .items {
        display: grid;
        gap: 12px;
        max-width: 60rem;
      }
    `,
  ];

  protected override render(): unknown {
    const name = this.path[0] ?? '';
    const items = this.core.model.menus.get(name) ?? [];
    return html`
      <h2>${name}</h2>
      ${items.length === 0 ? html`<p>The application's tables place nothing here.</p>` : ''}
      <div class="items">
        ${items.map((item) => html`<flexrf-item .core=${this.core} .item=${item}></flexrf-item>`)}
      </div>
    `;
  }
}
