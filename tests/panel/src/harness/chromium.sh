#!/usr/bin/env bash
# Starts the browser, /usr/bin/chromium or what FLEXRF_CHROMIUM names, without the right to raise its priority: started by root, it would
# give itself nice -8, and the applications and machines that run beside it would wait.
program=${FLEXRF_CHROMIUM:-/usr/bin/chromium}
if ((EUID == 0)); then exec setpriv --bounding-set -sys_nice "$program" "$@"; fi
exec "$program" "$@"
