# Two driven wheels on the lines of a GPIO chip, a camera, and what a small robot has around it.
robot rover
body 220 180 ahead 40

driver motors gpio pinctrl-bcm2711 left-dir 5 left-pwm 6 right-dir 13 right-pwm 19 rate 100
driver eye camera /dev/video0
driver board serial /dev/ttyUSB0 rate 115200

drive differential track 150 speed 500 turn 240 acceleration 1000 turn-acceleration 900 by motors

camera eye         at 130 0 height 150 facing 0 cone 60 from 100 to 2500 noise 10 error 2 rate 20 latency 60 by eye
range front        at 150 0 facing 0 cone 15 from 30 to 2000 step 10 noise 8 rate 20 latency 30 by board
range front-left   at 130 70 facing 40 cone 15 from 30 to 2000 step 10 noise 8 rate 20 latency 30 by board
range front-right  at 130 -70 facing -40 cone 15 from 30 to 2000 step 10 noise 8 rate 20 latency 30 by board
line tape          at 120 0 to 80 noise 2 rate 50 by board
bump bumper        at 150 0 facing 0 cone 180 rate 50 by board
odometry wheels    error 1 rate 50 by board
heading compass    noise 2 rate 20 by board
battery pack       from 6400 to 8400 step 10 noise 20 rate 1 by board
gripper hand       at 150 0 by board
light lamp         at 120 0 by board
sound horn         by board
