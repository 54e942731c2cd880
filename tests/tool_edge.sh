#!/bin/sh
# Edges from outside. Expected bytes are worked out by hand.
first_argument=
. tests/outside

same() { # same NAME FILE HEX : the same three rows of 4 pixels, or three rows
    rows=$3
    [ ${#rows} -eq 8 ] && rows=$3$3$3
    [ "$(od -An -v -tx1 "$2" | tr -d ' \n')" = "50350a3420330a3235350a$rows" ]
    say $? "$1"
}
# Three rows of 10 10 110 110: a step of 100 between columns 1 and 2; and its negative from 245 to 145.
printf 'P5\n4 3\n255\n\012\012\156\156\012\012\156\156\012\012\156\156' > step.pgm
printf 'P5\n4 3\n255\n\365\365\221\221\365\365\221\221\365\365\221\221' > down.pgm

works "edge" edge step.pgm -o out.pgm # 400 / 4
same "edge, Sobel's magnitude" out.pgm 00646400
works "edge --operator prewitt" edge --operator prewitt --gain 0.5 step.pgm -o out.pgm # 300 / 2
same "edge --operator prewitt, pixels" out.pgm 00969600
works "edge --operator isotropic" edge --operator isotropic step.pgm -o out.pgm # 341.4, 341 / 4
same "edge --operator isotropic, pixels" out.pgm 00555500
works "edge --operator roberts" edge --operator roberts step.pgm -o out.pgm # 200 / 4
same "edge --operator roberts, pixels" out.pgm 00320000
works "edge --operator laplacian --gain" edge --operator laplacian --gain 1 step.pgm -o out.pgm
same "edge --operator laplacian --gain, pixels" out.pgm 00646400
works "edge --operator laplacian" edge --operator laplacian step.pgm -o out.pgm # from 100 to -100
same "edge --operator laplacian, pixels" out.pgm 00ff0000
works "edge --operator laplacian --low" edge --operator laplacian --low 200 step.pgm -o out.pgm
same "edge --operator laplacian --low, pixels" out.pgm 00000000
works "edge --operator log" edge --operator log --sigma 0.5 step.pgm -o out.pgm
same "edge --operator log, pixels" out.pgm 00ff0000
works "edge --low" edge --low 399 step.pgm -o out.pgm
same "edge --low, pixels" out.pgm 00ffff00
works "edge --low, not above" edge --low 400 step.pgm -o out.pgm
same "edge --low, not above, pixels" out.pgm 00000000
works "edge --operator canny" edge --operator canny --sigma 0 step.pgm -o out.pgm
same "edge --operator canny, pixels" out.pgm 00ff0000
works "edge --operator canny --high" edge --operator canny --sigma 0 --low 300 --high 400 step.pgm -o out.pgm
same "edge --operator canny --high, pixels" out.pgm 00000000
works "edge --operator canny, smoothed" edge --operator canny --border reflect step.pgm -o out.pgm
works "edge --operator automaton" edge --operator automaton --low 99 step.pgm -o out.pgm
same "edge --operator automaton, pixels" out.pgm 00ffff00
works "edge --operator automaton --generations" edge --operator automaton --generations 16 --low 100 step.pgm -o out.pgm
same "edge --operator automaton --generations, pixels" out.pgm 00000000
works "edge --direction" edge --direction down.pgm -o out.pgm # half a turn, and 0 where there is none
same "edge --direction, pixels" out.pgm 00808000
works "edge --sigma" edge --sigma 1.4 step.pgm -o out.pgm
works "the same by two operations" pipe "blur --sigma 1.4 | edge" step.pgm -o two.pgm
cmp -s out.pgm two.pgm; say $? "the same by two operations, pixels"
works "edge --border skip" edge --border skip step.pgm -o out.pgm
same "edge --border skip, pixels" out.pgm 0a0a6e6e0a64646e0a0a6e6e
works "edge --border skip, mask" edge --border skip --low 100 step.pgm -o out.pgm
same "edge --border skip, mask, pixels" out.pgm 0000000000ffff0000000000
works "edge --roi" edge --roi 1,1,2,1 step.pgm -o out.pgm
same "edge --roi, pixels" out.pgm 0a0a6e6e0a64646e0a0a6e6e
works "edge of a mask" pipe "threshold --value 100 | edge --operator canny --sigma 0" step.pgm -o out.pgm
same "edge of a mask, pixels" out.pgm 00ff0000

refuses "an unknown operator" 2 "^iris edge: --operator: sobel, prewitt, .*, not 'x'" edge --operator x step.pgm -o no.pgm
refuses "--high without canny" 2 "^iris edge: --high: only with --operator canny" edge --high 9 step.pgm -o no.pgm
refuses "--high below --low" 2 "^iris edge: --high: at least --low, which is 40" edge --operator canny --high 9 step.pgm -o no.pgm
refuses "--direction of log" 2 "^iris edge: --direction: only with" edge --operator log --direction step.pgm -o no.pgm
refuses "--gain with --low" 2 "^iris edge: --gain: only with" edge --low 3 --gain 1 step.pgm -o no.pgm
refuses "--gain 16" 2 "^iris edge: --gain: 0 up to below 16" edge --gain 16 step.pgm -o no.pgm
refuses "--generations of sobel" 2 "^iris edge: --generations: only with" edge --generations 1 step.pgm -o no.pgm
refuses "--sigma 0.05" 2 "^iris edge: --sigma: 0, or 0.1 to 40" edge --sigma 0.05 step.pgm -o no.pgm
refuses "--sigma 0 of log" 2 "^iris edge: --sigma: 0.1 to 40 pixels with" edge --operator log --sigma 0 step.pgm -o no.pgm
refuses "--low 256 of automaton" 2 "^iris edge: --low: a whole number from 0 to 255" edge --operator automaton --low 256 step.pgm -o no.pgm
[ ! -e no.pgm ]; say $? "a wrong call writes nothing"
