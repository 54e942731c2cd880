#!/bin/sh
# score.sh : the figures that IRIS promises, one test each (make score shows them as a table).
exec "${OUT:?set by make}/iris-score" --tap --figures "$OUT/figures"
