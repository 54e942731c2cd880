# A model car: rear wheels driven, front wheels steered, all of it behind one serial port.
robot car
body 400 190 ahead 130

driver board serial /dev/ttyUSB0 rate 115200

drive ackermann track 160 wheelbase 260 steering 28 steering-rate 200 speed 800 turn 180 acceleration 1200

camera eye         at 280 0 height 120 facing 0 cone 70 from 100 to 3000 noise 10 error 2 rate 20 latency 60
# An infrared range sensor: counts of its converter fall as things are farther.
range front        at 330 0 facing 0 cone 5 from 100 to 800 noise 10 rate 25 calibrate 80 800 130 500 250 250 620 100
range left         at 300 80 facing 30 cone 20 from 30 to 2500 step 10 noise 10 rate 20 latency 30
range right        at 300 -80 facing -30 cone 20 from 30 to 2500 step 10 noise 10 rate 20 latency 30
range back         at -70 0 facing 180 cone 20 from 30 to 2500 step 10 noise 10 rate 20 latency 30
line tape          at 300 0 to 100 noise 2 rate 50
bump nose          at 330 0 facing 0 cone 120 rate 50
odometry wheels    error 2 rate 50
heading gyro       noise 1 rate 50
battery pack       from 6600 to 8400 step 10 noise 20 rate 1
light brake        at -70 0 facing 180
