#!/bin/sh
# election_model.sh : all states of the election between a few machines, looked at by spin; and the faults that it must
# find.
# What the model calls by the name of a function of src/borg/election.c is one.
model=$PWD/tests/borg/election.pml source=$PWD/src/borg/election.c
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
for step in accept be_granted promise give_back act_or_stop bid_or_claim claim_or_act forget decide; do
    grep -qw "$step" "$model" && grep -qE "^static [a-z0-9_]+ $step\(" "$source" || missing="$missing $step"
done
if [ -z "$missing" ]; then echo "ok - the model's steps are those of the source"
else echo "not ok - the model's steps are those of the source:$missing"; fi

# explore DEFINES... : what the model checker prints, in the file `said`.
explore() {
    spin -a "$@" "$model" > said 2>&1 &&
        ${CC:-cc} -O2 -w -DSAFETY -DCOLLAPSE -DNOFAIR -DMEMLIM=2000 -o pan pan.c >> said 2>&1 &&
        ./pan -m1000000 -w24 -E > said 2>&1
}

# holds WHAT DEFINES... : TAP. What was not looked at whole is no proof.
holds() {
    what=$1
    shift
    if explore "$@" && grep -q 'errors: 0' said && ! grep -qE 'too small|MEMLIM|not completed' said; then
        echo "ok - no violation in any state: $what"
        echo "#: election model, $what: $(sed -n 's/ *\([0-9.e+]*\) states, stored/\1/p' said) states, depth $(
            sed -n 's/.*depth reached \([0-9]*\).*/\1/p' said)"
    else
        echo "not ok - no violation in any state: $what"
        sed 's/^/# /' said
    fi
}

# finds WHAT DEFINES... : TAP.
finds() {
    what=$1
    shift
    if explore "$@" && grep -q 'assertion violated' said; then
        echo "ok - the model finds $what"
    else
        echo "not ok - the model finds $what"
        sed 's/^/# /' said
    fi
}

if ! command -v spin > /dev/null; then
    echo "ok - all states of the election # SKIP spin is not installed"
    exit 0
fi
holds "1 of 4, loss, a crash and a new start" -DN=4 -DK=1 -DLATE=0
holds "2 of 3, loss, a crash and a new start" -DN=3 -DK=2 -DLATE=0
holds "1 of 3, loss, a crash, a message late" -DN=3 -DK=1 -DLATE=1 -DRESTARTS=0
holds "1 of 3, loss, a crash and a new start, anybody apart at any time" -DN=3 -DK=1 -DLATE=0 -DCUT
finds "a promise forgotten while the grant is held" -DN=3 -DK=1 -DLATE=1 -DWRONG=1
finds "an answer to what was before giving back" -DN=3 -DK=1 -DLATE=1 -DWRONG=2
finds "a machine that grants as soon as it starts anew" -DN=3 -DK=1 -DLATE=0 -DCUT -DWRONG=3
finds "a machine with one grant too many" -DN=3 -DK=2 -DLATE=0 -DWRONG=4
finds "that two of three act" -DN=3 -DK=2 -DLATE=0 -DWRONG=5
finds "that one of four acts" -DN=4 -DK=1 -DLATE=0 -DWRONG=5
