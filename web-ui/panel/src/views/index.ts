// Every view of the panel, in the order of the navigation.
import type { ViewInfo } from './view';

export const views: readonly ViewInfo[] = [
  { name: 'overview', label: 'Overview', tag: 'flexrf-overview', load: () => import('./overview') },
  { name: 'log', label: 'Log', tag: 'flexrf-log', load: () => import('./log') },
  { name: 'menu', label: '', tag: 'flexrf-menu', load: () => import('./menu') },
];
