/* The election of include/iris/borg/election.h, for a model checker: what may happen between N machines, in any order.
 *
 * Steps are named as the functions of src/borg/election.c, and sets as its fields. What is left out there is left open
 * here: bids and rounds (any machine may claim, and give back, at any time, so that safety depends on no bid), and time
 * (anything may be forgotten at any time), but for what leases are for:
 *   - a promise is forgotten only when the other one's grant has ended (it counts from earlier, and ends MARGIN
 *     earlier); both are one step here;
 *   - a machine that starts anew is mute until the grants of its last start have ended.
 * BID and CLAIM are one: who does not act may send either; a BID gives back once more, which changes nothing when
 * nothing was claimed since.
 * Stamps: `before` has whose last claim, as it was heard, is of before that one gave back: answers to it do not count.
 * (Without late messages they may count: it is promised still.)
 * Any message may be lost: hearing is a step that need not be taken. LATE messages may be on their way for any time,
 * while newer ones arrive or not. The last machine (all are alike) may crash once, and start again. With CUT, anybody
 * may be unheard for ALIVE at any time, which means that they are apart.
 * Checked after every step: the promises of the header.
 *
 * WRONG=1: a promise is forgotten while the grant is held.    2: answers to what was before giving back count.
 *       3: a machine that starts anew grants at once.         4: a machine grants one too many.
 *       5: nothing; that K act is taken for wrong.
 * Each is found. tests/election_model.sh runs it. */
#ifndef N
#define N 4
#endif
#ifndef K
#define K 1
#endif
#ifndef LATE
#define LATE 1
#endif
#ifndef WRONG
#define WRONG 0
#endif
#ifndef RESTARTS
#define RESTARTS 1
#endif
#ifdef CUT
#define CAN_BE_GONE(u) (1)
#else
#define CAN_BE_GONE(u) ((u) == LAST && !is_on)
#endif

#define CLAIM 0 /* or BID */
#define ACT   1

#define BIT(u)       (1 << (u))
#define ALL          ((1 << N) - 1)
#define HAS(set, u)  (((set) >> (u)) & 1)
#define PUT(set, u)  set = set | BIT(u)
#define TAKE(set, u) set = set & (ALL ^ BIT(u))
#define COUNT(set)   (HAS(set, 0) + HAS(set, 1) + HAS(set, 2) + HAS(set, 3))
#define LAST         (N - 1)
#define ON(u)        ((u) != LAST || is_on)
#define MUTE(u)      ((u) == LAST && is_mute)
#define GRANTS_HAVE_ENDED(u) (!HAS(granted[0] | granted[1] | granted[2] | granted[3], u))

byte kind[4], alive[4], promised[4], before[4], granted[4], graced[4];
bit is_on, is_mute, has_crashed; /* the last machine */
byte knows_start;                /* who has heard its second start */

/* On their way: from whom, to whom, what. The first was sent first. */
typedef message {
    bit used, asks, grants, old_claim, old_answer; /* old: of before the one that asks gave back */
    bit second;                                    /* of the last machine's second start */
    byte from, to
}
message late[LATE + 1]; /* the last one is free */

byte i, j, which; /* 0 between steps */
hidden byte x, count, kept;
hidden byte asks, grants, old_claim, old_answer, second, again;

inline pick(u)
{
    if
    :: u = 0
    :: u = 1
    :: N > 2 -> u = 2
    :: N > 3 -> u = 3
    fi
}

/* What was granted until now counts no longer. */
inline outdate(u)
{
    x = 0;
    do
    :: x < N -> if :: LATE > 0 && HAS(promised[x], u) -> PUT(before[x], u) :: else fi; x++
    :: else -> break
    od;
    x = 0;
    do
    :: x < LATE ->
        late[x].old_claim = late[x].old_claim || late[x].from == u && late[x].asks;
        late[x].old_answer = late[x].old_answer || late[x].to == u && late[x].grants;
        x++
    :: else -> break
    od
}

inline give_back(u)
{
    kind[u] = CLAIM;
    TAKE(promised[u], u);
    TAKE(before[u], u);
    granted[u] = 0;
    graced[u] = 0;
    outdate(u)
}

inline act_or_stop(u)
{
    if
    :: kind[u] == ACT && (alive[u] & (ALL ^ BIT(u)) & (ALL ^ granted[u]) & (ALL ^ graced[u])) != 0 -> give_back(u)
    :: else
    fi
}

inline copy(to_place, from_place)
{
    late[to_place].used = late[from_place].used;
    late[to_place].asks = late[from_place].asks;
    late[to_place].grants = late[from_place].grants;
    late[to_place].old_claim = late[from_place].old_claim;
    late[to_place].old_answer = late[from_place].old_answer;
    late[to_place].second = late[from_place].second;
    late[to_place].from = late[from_place].from;
    late[to_place].to = late[from_place].to
}

/* Of the first `end` that are late, those from j to i are taken away: they will come after a newer one. */
inline drop_late(end)
{
    x = 0;
    kept = 0;
    do
    :: x < LATE ->
        if
        :: x < end && late[x].from == j && late[x].to == i -> skip
        :: else ->
            if :: kept != x -> copy(kept, x) :: else fi;
            kept++
        fi;
        x++
    :: else -> break
    od;
    do
    :: kept < LATE -> copy(kept, LATE); kept++
    :: else -> break
    od
}

inline accept()
{
    again = second && !HAS(knows_start, i);
    if :: again -> PUT(knows_start, i); TAKE(promised[i], j); TAKE(before[i], j) :: else fi;
    if
    :: again || !HAS(alive[i], j) ->
        TAKE(granted[i], j);
        if :: kind[i] == ACT -> PUT(graced[i], j) :: else fi
    :: else
    fi;
    PUT(alive[i], j)
}

inline be_granted()
{
    if
    :: grants && (!old_answer || WRONG == 2) -> PUT(granted[i], j); TAKE(graced[i], j)
    :: else
    fi
}

inline promise()
{
    if
    :: !asks -> TAKE(promised[i], j); TAKE(before[i], j)
    :: asks && HAS(promised[i], j) -> if :: old_claim -> PUT(before[i], j) :: else -> TAKE(before[i], j) fi
    :: asks && !HAS(promised[i], j) && !MUTE(i) && COUNT(promised[i]) < K + (WRONG == 4) ->
        PUT(promised[i], j);
        if :: old_claim -> PUT(before[i], j) :: else fi
    :: else
    fi
}

inline hear()
{
    if
    :: j == LAST && HAS(knows_start, i) && !second -> skip /* of an earlier start */
    :: else ->
        accept();
        be_granted();
        promise();
        act_or_stop(i)
    fi
}

/* Answers of u to v that are on their way are too old by now. */
inline void_grants(u, v)
{
    x = 0;
    do
    :: x < LATE ->
        if
        :: late[x].used && late[x].from == u && late[x].to == v ->
            late[x].grants = 0; late[x].old_answer = 0
        :: else
        fi;
        x++
    :: else -> break
    od
}

/* Who acts, or promises itself, sends no BID but gives back for it. */
inline snapshot(bids)
{
    asks = !bids;
    if :: bids -> give_back(j) :: else fi;
    grants = HAS(promised[j], i);
    old_answer = HAS(before[j], i);
    old_claim = 0;
    second = j == LAST && has_crashed && is_on
}

inline clear()
{
    i = 0; j = 0; x = 0; count = 0; kept = 0; which = 0;
    asks = 0; grants = 0; old_claim = 0; old_answer = 0; second = 0; again = 0
}

/* The promises of the header. */
inline check()
{
    j = 0;
    do
    :: j < N ->
        count = 0;
        x = 0;
        do
        :: x < N ->
            count = count + (kind[x] == ACT && (x == j || HAS(alive[x], j) && !HAS(graced[x], j)));
            x++
        :: else -> break
        od;
        assert(count <= K);
        j++
    :: else -> break
    od;
#ifndef CUT
    count = 0;
    x = 0;
    do
    :: x < N -> count = count + (kind[x] == ACT); x++
    :: else -> break
    od;
    assert(count <= K && !(WRONG == 5 && count == K));
#endif
    clear()
}

init
{
    d_step {
        is_on = 1;
        i = 0;
        do
        :: i < N -> alive[i] = ALL; i++
        :: else -> break
        od;
        clear()
    };
    do
    /* i hears what j sends now. */
    :: atomic { pick(i); pick(j); i != j && ON(i) && ON(j) ->
        if
        :: !MUTE(j) -> d_step { snapshot(0); drop_late(LATE); hear(); check() }
        :: d_step { snapshot(1); drop_late(LATE); hear(); check() }
        fi }

    /* j sends what will come late. */
    :: atomic { pick(i); pick(j); i != j && ON(i) && ON(j) && LATE > 0 && !late[LATE - (LATE > 0)].used ->
        if :: !MUTE(j) -> which = 0 :: which = 1 fi;
        d_step {
            snapshot(which);
            x = 0;
            do
            :: late[x].used -> x++
            :: else -> break
            od;
            late[x].used = 1; late[x].from = j; late[x].to = i; late[x].asks = asks; late[x].grants = grants;
            late[x].old_answer = old_answer; late[x].second = second;
            clear()
        } }

    /* It comes. */
    :: atomic { LATE > 0 && late[0].used -> if :: which = 0 :: LATE > 1 && late[1].used -> which = 1 fi;
        d_step {
            i = late[which].to; j = late[which].from; asks = late[which].asks; grants = late[which].grants;
            old_claim = late[which].old_claim; old_answer = late[which].old_answer; second = late[which].second;
            drop_late(which + 1);
            if :: ON(i) -> hear() :: else fi;
            check()
        } }

    /* forget */
    :: atomic { pick(i); pick(j); i != j && HAS(graced[i], j) ->
        d_step { TAKE(graced[i], j); act_or_stop(i); check() } }
    :: atomic { pick(i); pick(j); i != j && ON(i) && HAS(alive[i], j) && CAN_BE_GONE(j) ->
        d_step { TAKE(alive[i], j); TAKE(graced[i], j); check() } }
    :: atomic { pick(i); pick(j); i != j && HAS(promised[i], j) ->
        d_step {
            if :: WRONG != 1 -> void_grants(i, j); TAKE(granted[j], i); act_or_stop(j) :: else fi;
            TAKE(promised[i], j);
            TAKE(before[i], j);
            check()
        } }

    /* decide: bid_or_claim, claim_or_act, and when another one is better */
    :: atomic { pick(i); ON(i) && !MUTE(i) && kind[i] == CLAIM && !HAS(promised[i], i) &&
        COUNT(promised[i]) < K + (WRONG == 4) ->
        d_step { PUT(promised[i], i); clear() } }
    :: atomic { pick(i); kind[i] == CLAIM && HAS(promised[i], i) && (granted[i] | BIT(i) | (ALL ^ alive[i])) == ALL ->
        d_step { kind[i] = ACT; graced[i] = 0; check() } }
    :: atomic { pick(i); HAS(promised[i], i) || granted[i] != 0 -> d_step { give_back(i); clear() } }

    /* The last one crashes, and starts again. */
    :: is_on && !has_crashed ->
        d_step { has_crashed = 1; is_on = 0; give_back(LAST); promised[LAST] = 0; before[LAST] = 0; alive[LAST] = ALL;
                 clear() }
    :: !is_on && RESTARTS -> d_step { is_on = 1; is_mute = 1 }
    :: is_mute && (WRONG == 3 || GRANTS_HAVE_ENDED(LAST)) ->
        d_step {
            is_mute = 0;
            i = 0;
            do
            :: i < LAST -> if :: WRONG != 3 -> void_grants(LAST, i) :: else fi; i++
            :: else -> break
            od;
            clear()
        }
    od
}
