# Three wheels that roll sideways, too; in the simulator only.
robot omni
body 240 240

driver here simulated

drive omni wheels 3 radius 100 speed 600 turn 270 acceleration 1500 turn-acceleration 1200

camera eye         at 100 0 height 200 facing 0 cone 90 from 100 to 2500 noise 10 error 2 rate 20 latency 40
range r0           at 115 0 facing 0 cone 20 from 20 to 2000 step 5 noise 5 rate 30
range r60          at 58 100 facing 60 cone 20 from 20 to 2000 step 5 noise 5 rate 30
range r120         at -58 100 facing 120 cone 20 from 20 to 2000 step 5 noise 5 rate 30
range r180         at -115 0 facing 180 cone 20 from 20 to 2000 step 5 noise 5 rate 30
range r240         at -58 -100 facing -120 cone 20 from 20 to 2000 step 5 noise 5 rate 30
range r300         at 58 -100 facing -60 cone 20 from 20 to 2000 step 5 noise 5 rate 30
line tape          at 100 0 to 80 noise 2 rate 50
bump ring          cone 360 rate 50
odometry wheels    error 3 rate 50
heading gyro       noise 1 rate 50
battery pack       from 9900 to 12600 step 10 noise 20 rate 1
sound horn
