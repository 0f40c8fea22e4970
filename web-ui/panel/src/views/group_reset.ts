// Sets all runtime parameters of a component back that are not their defaults, after a question: there while there are any.
import { css, html, nothing } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import type { Value } from '../contract';
import type { Item } from '../core/descriptor';
import { controlStyles } from '../widgets/control_styles';
import { Question } from '../widgets/question';
import { isModified, isParameter } from './search_rows';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';

@customElement('flexrf-group-reset')
export class GroupReset extends ViewBase {
  static override styles = [
    ...viewStyles,
    controlStyles,
    css`
      /* Its question lies over what is below, as those of widgets do. */
      :host {
        display: inline-block;
        position: relative;
        z-index: 1;
        content-visibility: visible;
      }
    `,
  ];

  /** Of one component; others than runtime parameters are left alone. */
  @property({ attribute: false }) items: readonly Item[] = [];
  private watched: readonly Item[] = [];
  private unwatch: (() => void)[] = [];
  private values = new Map<string, Value | null>();
  private count = 0;
  private readonly question = new Question(
    () => `Set back to the default: ${this.modified().map((item) => item.label).join(', ')}?`,
    () => this.requestUpdate(),
  );

  override connectedCallback(): void {
    super.connectedCallback();
    this.until(this.core.host.watchAccess(() => {
      if (this.question.open && this.denied() !== '') this.question.answer(false);
      this.requestUpdate();
    }));
    this.until(() => {
      this.unwatch.forEach((end) => end());
      this.unwatch = [];
      this.watched = [];
    });
    this.requestUpdate();
  }

  protected override willUpdate(): void {
    if (this.watched === this.items) return;
    this.watched = this.items;
    this.unwatch.forEach((end) => end());
    this.values.clear();
    this.unwatch = this.items.filter((item) => item.kind === 'runtime' && isParameter(item) && item.default !== undefined).map((item) =>
      this.core.host.watch(item.key, ({ value }) => {
        this.values.set(item.key, value);
        const count = this.modified().length;
        if (count === this.count) return;
        this.count = count;
        this.requestUpdate();
      }, { rate: 2 }));
  }

  protected override updated(): void {
    this.question.place(this.renderRoot);
  }

  private modified(): Item[] {
    return this.items.filter((item) => isModified(item, this.values.get(item.key)));
  }

  private denied(): string {
    return this.modified().map((item) => this.core.host.locked(item.key)).find((reason) => reason !== '') ?? '';
  }

  protected override render(): unknown {
    const modified = this.modified();
    const component = modified[0]?.component;
    if (component === undefined) return nothing;
    const denied = this.denied();
    return html`<button
        ?disabled=${denied !== '' || this.question.open}
        title=${denied || nothing}
        aria-label="Reset ${modified.length} modified of ${component}"
        @click=${() => this.question.ask(() => void this.reset())}
      >↺ Reset ${modified.length} modified</button>
      ${this.question.render(component)}`;
  }

  private async reset(): Promise<void> {
    const modified = this.modified();
    const component = modified[0]?.component;
    if (component === undefined) return;
    const outcome = await this.core.host.resetAll(component, modified.map((item) => item.path ?? ''));
    if (!outcome.ok) this.core.notify(outcome.detail, 'warning');
  }
}
