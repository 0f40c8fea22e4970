// Begins the page.
import './shell/app';

// The one-time token has done its work when the page is here: it shall not be copied along with the address.
const address = new URL(location.href);
if (address.searchParams.has('token')) {
  address.searchParams.delete('token');
  history.replaceState(null, '', address);
}
