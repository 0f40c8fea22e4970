// The contract between the shell and a view: one page of the panel behind one name in the address.
import type { Role, WidgetHost } from '../contract';
import type { Core } from '../core/core';

/**
 * A view is a custom element. The shell sets these properties before it is connected, and `path` again whenever the
 * address changes within the view: "#/units/axis[0].drive" gives the view `units` the path ["axis[0].drive"].
 * A view is taken from the document when another is shown, and when the application restarted with another descriptor
 * (then a new one is made): what it began in connectedCallback it ends in disconnectedCallback.
 */
export interface ViewElement extends HTMLElement {
  core: Core;
  host: WidgetHost;
  path: readonly string[];
}

/** One line of src/views/index.ts. */
export interface ViewInfo {
  /** First part of the address: "units" in "#/units/jog". */
  readonly name: string;
  /** Entry of the navigation; empty for a view that is reached by links only. */
  readonly label: string;
  /** Least role that finds it in the navigation; without it everybody does. The server judges what it may read. */
  readonly role?: Role;
  /** Only where the application runs on a PC of FlexRF. */
  readonly onMachine?: true;
  /** The custom element's name, defined by the module that `load` imports. */
  readonly tag: string;
  /** A dynamic import, so that the first view stays small. */
  readonly load: () => Promise<unknown>;
}
