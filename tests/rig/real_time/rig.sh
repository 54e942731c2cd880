#!/bin/sh
# The virtual machine itself: its drivers are there and do what the tests of the library rely on.
say() { # say CODE NAME
    if [ "$1" -eq 0 ]; then echo "ok - $2"; else echo "not ok - $2"; fi
}
have() { # have VALUE NAME : 0 when there is one; else NAME is skipped
    [ -n "$1" ] || { echo "ok - $2 # SKIP could not be had when the rig was prepared"; return 1; }
}
cd /tmp || exit 1

loaded=$(cut -d ' ' -f 1 /proc/modules)
for module in vivid videobuf2_v4l2 ftdi_sio xhci_pci virtio_console overlay; do
    echo "$loaded" | grep -qx $module; say $? "module $module"
done
for module in gpio-sim vimc; do
    have "$(ls /lib/modules/rig/$module.ko 2> /dev/null)" "module $module" || continue
    echo "$loaded" | grep -qx "$(echo $module | tr - _)"; say $? "module $module"
done
for node in "$RIG_WEBCAM" "$RIG_LOOP_IN" "$RIG_LOOP_OUT" "$RIG_PLANES_IN" "$RIG_PLANES_OUT" "$RIG_SERIAL" "$RIG_USB_SERIAL" \
    "$RIG_BARE_SERIAL"; do
    [ -c "$node" ]; say $? "device ${node:-with an empty name}"
done
[ "$(printf '%s\n' "$RIG_WEBCAM" "$RIG_LOOP_IN" "$RIG_LOOP_OUT" "$RIG_PLANES_IN" "$RIG_PLANES_OUT" | sort -u | wc -l)" -eq 5 ]
say $? "five different cameras"
if have "$RIG_MEDIA_CAMERA" "vimc's media device"; then
    [ -c "$RIG_MEDIA_CAMERA" ] && [ -e "/run/udev/data/c$(cat "/sys/bus/media/devices/${RIG_MEDIA_CAMERA##*/}/dev")" ]
    say $? "vimc's media device, ready for libcamera"
fi
if have "$RIG_GPIO" "GPIO"; then
    [ -c "$RIG_GPIO" ] && [ "$(cat "$RIG_GPIO_SYSFS/sim_gpio3/value")" = 0 ] &&
        echo pull-up > "$RIG_GPIO_SYSFS/sim_gpio3/pull" && [ "$(cat "$RIG_GPIO_SYSFS/sim_gpio3/value")" = 1 ] &&
        echo pull-down > "$RIG_GPIO_SYSFS/sim_gpio3/pull" && [ "$(cat "$RIG_GPIO_SYSFS/sim_gpio3/value")" = 0 ]
    say $? "a GPIO line is pulled up and reads back"
fi

awk 'BEGIN { for (i = 0; i < 256; i++) printf "%02x", i }' | xxd -r -p > all
crosses() { # crosses PORT NODE : all 256 values both ways
    stty -F "$2" raw -echo 115200
    rig clear "$1"
    cat all > "$2"
    rig received "$1" 256 > far
    cmp -s all far; say $? "$1: every byte crosses to the host"
    exec 4<> "$2"
    timeout 10 head -c 256 <&4 > near &
    rig send "$1" < all
    wait $!
    exec 4>&-
    cmp -s all near; say $? "$1: every byte crosses from the host"
}
[ "$(wc -c < all)" -eq 256 ]; say $? "256 bytes to send"
crosses serial "$RIG_SERIAL"
crosses usb "$RIG_USB_SERIAL"
rig received serial 0 > far
[ ! -s far ]; say $? "nothing arrived twice"
rig received serial 1 200 > far
[ ! -s far ]; say $? "waiting for what does not come ends"
rig unplug && [ ! -e "$RIG_USB_SERIAL" ]; say $? "unplugged, the node is gone"
rig unplug 2> err; [ $? -eq 1 ] && grep -q usb0 err; say $? "unplugging twice is an error"
rig plug && [ -c "$RIG_USB_SERIAL" ]; say $? "plugged, the node is back"
crosses usb "$RIG_USB_SERIAL"
! (echo > "$RIG_BARE_SERIAL") 2> /dev/null; say $? "the port without hardware refuses"

cameras() { # the names of vivid's nodes
    cat /sys/class/video4linux/video*/name | grep vivid | sort | tr '\n' ' '
}
before=$(cameras)
rig vivid n_devs=1 node_types=0x1 && [ "$(cameras)" = "vivid-000-vid-cap " ]; say $? "vivid with other parameters"
rig vivid && [ "$(cameras)" = "$before" ]; say $? "vivid as before"
