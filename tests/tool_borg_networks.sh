#!/bin/sh
# iris borg run on five machines: each robot has a network of its own (a namespace), joined with the others' by a bridge, that
# has one, too. With what netem does to a network where the kernel has it: in the virtual machine (tests/rig/guest).
here=$PWD
. tests/outside
script=$here/examples/scripts/explore.borg
PATH=$PATH:/usr/sbin:/sbin
space=iris$$
processes=
broker=
leave() {
    for process in $processes $broker; do kill -9 "$process" 2> /dev/null; done
    for i in 0 1 2 3 4 5; do ip netns del $space-$i 2> /dev/null; done
    rm -rf "$root"
}
trap leave EXIT
skip() { # skip WHY
    for what in "UDP" "MQTT" "UDP with netem" "MQTT with netem"; do echo "ok - five networks, $what # SKIP $1"; done
    exit 0
}
command -v ip > /dev/null || skip "no ip (make deps: iproute2)"
build() {
    ip netns add $space-0 && ip -n $space-0 link set lo up && ip -n $space-0 link add hub type bridge mcast_snooping 0 &&
        ip -n $space-0 addr add 10.73.82.100/24 dev hub && ip -n $space-0 link set hub up || return 1
    for i in 1 2 3 4 5; do
        ip netns add $space-$i && ip -n $space-0 link add port$i type veth peer name eth0 netns $space-$i &&
            ip -n $space-0 link set port$i master hub up && ip -n $space-$i addr add 10.73.82.$i/24 dev eth0 &&
            ip -n $space-$i link set lo up && ip -n $space-$i link set eth0 up || return 1
    done
}
build > err 2>&1 || skip "networks of one's own cannot be made here ($(tail -1 err))"

inside() { # inside NUMBER COMMAND... : in that network
    number=$1
    shift
    ip netns exec $space-"$number" "$@"
}
mission() { # mission NAME SPEED TRANSPORT
    i=0
    started=
    for robot in 10.1 20.1 20.2 20.3 20.4; do
        i=$((i + 1))
        inside $i timeout 200 "$iris" borg run "$script" --ref "${robot%.*}" --unit "${robot#*.}" --transport "$3" --speed "$2" \
            --timeout 20 > robot.$i 2> err.$i < /dev/null &
        started="$started $!"
    done
    processes="$processes $started"
    good=0
    for process in $started; do wait "$process" || good=1; done
    cat err.? > err
    sed -n 's|^\([0-9]*\)/[0-9]* at ([-0-9, ]*) mm: \(.*\)|\1 \2|p' robot.? | sort > out
    [ $good -eq 0 ] && [ "$(cat out)" = '10 following stopped
20 exploring going reached
20 exploring going reached
20 exploring stopped
20 exploring stopped' ]; say $? "five networks, $1: two of four go, all stop"
}
udp=udp:239.255.73.82:7382,eth0
mqtt=mqtt://10.73.82.100/fleet
mosquitto=$(command -v mosquitto)
no_mqtt=
[ -n "$mosquitto" ] || no_mqtt="no broker: mosquitto is not installed (make deps)"
timeout 2 "$iris" borg run --ref 1 --unit 1 --transport mqtt://127.0.0.1:1 2>&1 < /dev/null | grep -q libmosquitto &&
    no_mqtt="this build has no libmosquitto"
if [ -z "$no_mqtt" ]; then
    printf '%s\n' "listener 1883" "allow_anonymous true" "persistence false" "user root" "log_dest none" > broker.conf
    ip netns exec $space-0 "$mosquitto" -c broker.conf > /dev/null 2>&1 &
    broker=$!
fi
mission "UDP" 2 $udp
if [ -z "$no_mqtt" ]; then mission "MQTT" 2 $mqtt; else echo "ok - five networks, MQTT # SKIP $no_mqtt"; fi

# What each robot sends is late by 10 to 30 ms, so that it is reordered; a fifth is lost, and a twentieth comes twice.
for i in 1 2 3 4 5; do
    if ! tc -n $space-$i qdisc add dev eth0 root netem delay 20ms 10ms loss 20% duplicate 5% > err 2>&1; then
        echo "ok - five networks, UDP with netem # SKIP this kernel has no sch_netem"
        echo "ok - five networks, MQTT with netem # SKIP this kernel has no sch_netem"
        exit 0
    fi
done
mission "UDP with netem" 1 $udp
if [ -z "$no_mqtt" ]; then mission "MQTT with netem" 1 $mqtt; else echo "ok - five networks, MQTT with netem # SKIP $no_mqtt"; fi
