// Every view of the panel, in the order of the navigation.
import type { ViewInfo } from './view';

export const views: readonly ViewInfo[] = [
  { name: 'overview', label: 'Overview', tag: 'flexrf-overview', load: () => import('./overview') },
  { name: 'units', label: 'Units', tag: 'flexrf-units', load: () => import('./components') },
  { name: 'devices', label: 'Devices', tag: 'flexrf-devices', load: () => import('./components') },
  { name: 'blackboard', label: 'Blackboard', tag: 'flexrf-blackboard', load: () => import('./blackboard') },
  { name: 'search', label: 'Search', tag: 'flexrf-search', load: () => import('./search') },
  { name: 'threads', label: 'Threads', tag: 'flexrf-threads', load: () => import('./threads') },
  { name: 'log', label: 'Log', tag: 'flexrf-log', load: () => import('./log') },
  { name: 'audit', label: 'Audit', role: 'admin', tag: 'flexrf-audit', load: () => import('./audit') },
  { name: 'machine', label: 'Machine', onMachine: true, tag: 'flexrf-machine', load: () => import('./machine') },
  { name: 'menu', label: '', tag: 'flexrf-menu', load: () => import('./menu') },
];
