#!/bin/sh
# The kernel here has netem: a team whose network loses, delays, reorders, and doubles what is sent.
exec tests/tool_borg_networks.sh
