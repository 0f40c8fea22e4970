// The address behind '#': which view, and where in it. "#/units/axis[0].drive" is the view "units", path ["axis[0].drive"].

export interface Route {
  readonly view: string;
  readonly path: readonly string[];
}

function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part; // typed by hand, with a lone '%'
  }
}

export function parseRoute(hash: string, first: string): Route {
  const [view, ...path] = hash.replace(/^#\/?/, '').split('/').filter((part) => part !== '').map(decoded);
  return { view: view ?? first, path };
}

export function addressOfRoute(route: Route): string {
  return `#/${[route.view, ...route.path].map(encodeURIComponent).join('/')}`;
}
