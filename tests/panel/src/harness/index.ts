export * from './application';
export * from './browser';
export * from './cable';
export * from './environment';
export * from './processes';
export * from './rest';
export * from './screenshot';
export * from './socket';
