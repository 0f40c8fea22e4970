// Begins the page.
import './shell/app';
