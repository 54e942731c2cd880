#!/bin/sh
# Steering out of iris follow, from outside: wrong calls, and a robot at the far end of a pseudo-terminal that is told to stop
# whatever happens to the program. GPIO lines that can be driven are in the rig: tests/rig/real_time/gpio_follow.c.
first_argument=follow
. tests/outside
LC_ALL=C
export LC_ALL

awk 'BEGIN { printf "P5 64 48 255\n"; for (y = 0; y < 48; y++) for (x = 0; x < 64; x++)
    printf "%s", (x >= 40 && x < 48) ? " " : "~" }' > right.pgm

# --- wrong calls ---
for wrong in "" gpiochip0 gpiochip0: gpiochip0:left :left=1 left=1 =1 "$(printf 'c%400s' | tr ' ' x):left=1"; do
    refuses "--gpio '$(echo "$wrong" | cut -c 1-20)'" 2 '^iris follow: --gpio: a chip and its lines' --gpio "$wrong" right.pgm
done
for wrong in up=1 Left=1 left-pwm2=1 stop-=1 =1 left=1,up=2 left=1,, left=1,right left=1,2; do
    refuses "--gpio chip:$wrong" 2 '^iris follow: --gpio: a line is left, right, ' --gpio "chip:$wrong" right.pgm
done
for wrong in left= left=x left=-1 left=1.5 left=99999999999 "left= 1" left=0x10 stop=:safe=1; do
    refuses "--gpio chip:$wrong" 2 "^iris follow: --gpio: (left|stop): a number of a line, 0 or more" --gpio "chip:$wrong" right.pgm
done
for wrong in left=1:low left=1:safe left=1:safe=2 left=1:safe= left=1:initial=-1 left=1:active-low=1 left=1: left=1:safe=1:x; do
    refuses "--gpio chip:$wrong" 2 '^iris follow: --gpio: active-low, initial=0' --gpio "chip:$wrong" right.pgm
done
refuses "a line twice" 2 '^iris follow: --gpio: left is given twice$' --gpio chip:left=1,left=2 right.pgm
refuses "a number twice" 2 '^iris follow: --gpio: 1 is given twice$' --gpio chip:left=1,right=1 right.pgm
for wheel in left right; do
    refuses "a motor that runs before any command: $wheel" 2 "^iris follow: --gpio: $wheel-pwm: initial=1 would drive the motor" \
        --gpio chip:stop=3,$wheel-pwm=1:initial=1 right.pgm
done
refuses "one wheel" 2 'two wheels need both$' --gpio chip:left-pwm=1,left-dir=2 right.pgm
refuses "directions alone" 2 'only together with left-pwm and right-pwm$' --gpio chip:left-dir=1,right-dir=2 right.pgm
for wrong in 0 1001 x; do
    refuses "--pwm $wrong" 2 '^iris follow: --pwm: ' --gpio chip:left-pwm=1,right-pwm=2 --pwm $wrong right.pgm
done
refuses "--pwm without motors" 2 '^iris follow: --pwm: only together' --gpio chip:left=1 --pwm 50 right.pgm
for wrong in "" 0 9ms 0s 61s 60001 -5 1.5s 200us s 9999999 "200 ms"; do
    refuses "--watchdog '$wrong'" 2 '^iris follow: --watchdog: ' --serial /dev/none --watchdog "$wrong" right.pgm
done
refuses "--watchdog alone" 2 '^iris follow: --watchdog: only together with --serial or --gpio$' --watchdog 1s right.pgm

# --- what is no chip ---
run --gpio no-such-chip:left=1 right.pgm
if grep -q libgpiod err; then
    [ $code -eq 1 ] && [ "$(wc -l < err)" -eq 1 ] && [ ! -s out ]; say $? "a build without libgpiod says so"
else
    for chip in no-such-chip gpiochip999 /dev/none INT33FC:00; do
        refuses "--gpio $chip" 1 "^iris follow: $chip: no such GPIO chip\$" --gpio "$chip:left=1:active-low:initial=1:safe=0,stop=2" right.pgm
    done
    refuses "--gpio on a device of another kind" 1 '^iris follow: /dev/null: not a GPIO chip$' --gpio /dev/null:stop=1 right.pgm
fi

# --- the robot's end of a port ---
if ! python3 -c 'import pty' 2> /dev/null; then
    echo "ok - a robot that is told to stop # SKIP no python3"
    exit
fi
cat > robot.py <<'END'
import ctypes, os, pty, signal, subprocess, sys, time, tty
iris = sys.argv[1]
frame = open("right.pgm", "rb").read()
LATE = 3.0 # seconds that a busy machine may take longer than is stated
def say(good, name, seen=""):
    print(("ok - " if good else "not ok - ") + name + ("" if good else "\n# " + repr(seen)), flush=True)

class Robot:
    """The tool, and what arrives at the far end of its port: (seconds, sequence, state, speed) of each sentence."""
    def __init__(self, *words, source="-", stderr=subprocess.PIPE):
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        os.set_blocking(self.master, False)
        self.text, self.heard = b"", []
        self.tool = subprocess.Popen([iris, "follow", "--serial", os.ttyname(self.slave), *words, source], stdin=subprocess.PIPE,
                                     stdout=subprocess.PIPE, stderr=stderr, start_new_session=True)
    def listen(self, seconds, until=lambda robot: False):
        end = time.time() + seconds
        while True:
            try:
                self.text += os.read(self.master, 4096)
            except OSError:
                pass
            *whole, self.text = self.text.split(b"\r\n")
            for sentence in whole:
                part = sentence.decode().split(",")
                self.heard.append((time.time(), int(part[1]), part[2], int(part[4])))
            if until(self) or time.time() >= end:
                return until(self)
            time.sleep(0.002)
    def drive(self, count=3):
        for i in range(count):
            before = len(self.heard)
            self.show()
            self.moved = time.time()
            self.listen(LATE, lambda r: len(r.heard) > before and r.stands(False))
        return self.stands(False)
    def stands(self, wanted=True):
        return bool(self.heard) and (self.heard[-1][2:] == ("L", 0)) == wanted
    def show(self): # a frame, until it has been answered: its command is on its way
        self.tool.stdin.write(frame)
        self.tool.stdin.flush()
        self.tool.stdout.readline()
    def only_stands(self, before, seconds):
        self.listen(seconds)
        return all(h[2:] == ("L", 0) for h in self.heard[before:])
    def process(self):
        for pid in filter(str.isdigit, os.listdir("/proc")):
            try:
                if int(open("/proc/%s/stat" % pid).read().rsplit(")", 1)[1].split()[1]) == self.tool.pid:
                    return int(pid)
            except OSError:
                pass
    def is_alive(self, pid):
        try:
            return open("/proc/%d/stat" % pid).read().rsplit(")", 1)[1].split()[0] != "Z"
        except OSError:
            return False
    def end(self):
        out, err = self.tool.communicate(timeout=20)
        self.listen(0.05)
        os.close(self.master)
        os.close(self.slave)
        return self.tool.returncode, (err or b"").decode()

# Frames stay away.
r = Robot("--watchdog", "300ms")
moves = r.drive()
stopped = r.listen(0.3 + LATE, Robot.stands)
say(moves and stopped and r.heard[-1][0] - r.moved > 0.25, "no frame for --watchdog: the robot is stopped, and not before", r.heard)
print("#: the stop came %d ms after the last frame, of 300" % (1000 * (r.heard[-1][0] - r.moved)))
before = len(r.heard)
r.listen(1.05)
say(5 <= len(r.heard) - before <= 12 and all(h[2] == "L" for h in r.heard[before:]), "which is said ten times a second", r.heard[before:])
moves = r.drive(1)
say(moves, "a command makes it drive again", r.heard[-3:])
order = [h[1] for h in r.heard]
say(order == sorted(set(order)), "every sentence has a number of its own", order)
code, err = r.end()
say(code == 0 and r.stands() and err.startswith("iris follow: --watchdog: no command for 300 ms: the robot is stopped until the next\n"),
    "said once, and the robot stands in the end", (code, err))

# No frame at all.
begin = time.time()
r = Robot("--watchdog", "700ms")
stopped = r.listen(0.7 + 2 * LATE, Robot.stands)
say(stopped and r.heard[0][0] - begin >= 0.7, "no first frame for --watchdog: the robot is stopped, and not before", (begin, r.heard))
say(r.listen(0.3 + LATE, lambda r: len(r.heard) > 2) and r.drive(1), "again and again, until the first", r.heard)
code, err = r.end()
say(code == 0 and err == "", "of which nothing is said", (code, err))

# The frames of a camera stay away: long before the watchdog's time.
r = Robot("--watchdog", "60s", source="--camera=-")
say(r.drive() and r.listen(0.25 + 2 * LATE, Robot.stands), "a camera without frames: the robot is stopped", r.heard)
say(r.listen(0.3 + LATE, lambda r: len(r.heard) > 5) and r.drive(1), "again and again, until there are frames", r.heard)
order = [h[1] for h in r.heard]
say(order == list(range(len(order))), "a camera without frames: every sentence has a number of its own, without a gap", order)
say(r.end()[0] == 0 and r.stands(), "a camera without frames: the robot stands in the end", r.heard)

# The default: three frames, at least 200 ms.
for rate, expected in ("5", 0.6), ("100", 0.2):
    r = Robot("--rate", rate)
    r.drive()
    r.listen(expected + LATE, Robot.stands)
    took = r.heard[-1][0] - r.moved
    say(r.stands() and expected - 0.05 < took, "the default at --rate %s: %g s" % (rate, expected), (took, r.heard))
    r.end()

# The program hangs, as in a driver.
r = Robot("--watchdog", "300ms")
r.drive()
os.kill(r.tool.pid, signal.SIGSTOP)
say(r.listen(0.3 + LATE, Robot.stands), "a halted program: the robot is stopped", r.heard)
os.kill(r.tool.pid, signal.SIGCONT)
say(r.drive(), "and drives when it goes on", r.heard[-3:])
r.end()

# The program ends, however it does.
for name in "SIGINT", "SIGTERM", "SIGHUP", "SIGKILL", "SIGSEGV", "SIGABRT":
    r = Robot("--watchdog", "10s")
    moves, process, number = r.drive(), r.process(), getattr(signal, name)
    sent = time.time()
    os.kill(r.tool.pid, number)
    stopped = r.listen(LATE, Robot.stands)
    took = time.time() - sent
    code, err = r.end()
    say(moves and stopped and code == -number, name + ": the robot is stopped", (code, err, r.heard))
    print("#: %s to the stop: %d ms" % (name, 1000 * took))
    orderly = name in ("SIGINT", "SIGTERM", "SIGHUP")
    say(err == "" if orderly else "ended without a word" in err, name + ": said when nobody meant it", err)
    say(not r.is_alive(process), name + ": nothing is left behind", process)
r = Robot("--watchdog", "10s")
r.drive()
os.killpg(r.tool.pid, signal.SIGKILL)
say(r.listen(LATE, Robot.stands), "its whole process group killed: the robot is stopped", r.heard)
r.end()

# First the robot, then the program: as long as the one was not told, the other stays.
r = Robot("--watchdog", "10s")
r.drive()
process = r.process()
os.kill(process, signal.SIGSTOP)
os.kill(r.tool.pid, signal.SIGTERM)
r.listen(0.4)
stays = r.tool.poll() is None and r.stands(False)
os.kill(process, signal.SIGCONT)
stopped = r.listen(LATE, Robot.stands)
code, err = r.end()
say(stays and stopped and code == -signal.SIGTERM and err == "", "a signal: the robot is stopped before the program ends", (stays, code, err))

# The program is killed while its steering process is halted.
r = Robot("--watchdog", "10s")
r.drive()
os.kill(r.process(), signal.SIGSTOP)
os.kill(r.tool.pid, signal.SIGKILL)
say(r.listen(LATE, Robot.stands) and r.end()[0] == -signal.SIGKILL, "killed while its steering process is halted: the robot is stopped", r.heard)

# What lies between the two when one of them has been held up, as by a debugger: that does not wake it up.
ptrace = ctypes.CDLL(None, use_errno=True).ptrace
ptrace.argtypes = [ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p]
def hold(pid):
    if ptrace(16, pid, None, None) != 0: # PTRACE_ATTACH
        return False
    os.waitpid(pid, 0x40000000) # __WALL
    return True
def let_go(pid):
    return ptrace(17, pid, None, None) == 0 # PTRACE_DETACH
late, last = "a command that comes too late is not obeyed", "the last command of a program that is killed is not obeyed"
r = Robot("--watchdog", "1s")
r.drive()
process, before = r.process(), len(r.heard)
if hold(process):
    r.show()
    os.kill(r.tool.pid, signal.SIGSTOP) # it would find its steering process hanging
    time.sleep(1.2)
    let_go(process)
    say(r.listen(LATE, Robot.stands) and r.only_stands(before, 0.1), late, r.heard[before:])
    os.kill(r.tool.pid, signal.SIGCONT)
    say(r.drive(1) and r.end()[0] == 0, "and the next one is", r.heard[before:])
    r = Robot("--watchdog", "10s")
    r.drive()
    process, before = r.process(), len(r.heard)
    held = hold(process)
    r.show()
    r.tool.kill()
    r.tool.wait()
    let_go(process)
    say(held and r.listen(LATE, Robot.stands) and r.only_stands(before, 0.1), last, r.heard[before:])
    r.end()
else:
    r.end()
    for name in late, last:
        print("ok - %s # SKIP a process cannot be held here: %s" % (name, os.strerror(ctypes.get_errno())))

# Nobody reads what is complained.
nobody, full = os.pipe()
os.set_blocking(full, False)
try:
    while True:
        os.write(full, b"x" * 512)
except BlockingIOError:
    os.set_blocking(full, True)
r = Robot("--watchdog", "300ms", stderr=full)
moves, stopped, before = r.drive(), r.listen(0.3 + LATE, Robot.stands), len(r.heard)
say(moves and stopped and r.listen(0.3 + LATE, lambda r: len(r.heard) > before + 2), "nobody reads stderr: the robot is stopped again and again", r.heard)
say(r.drive(1), "nobody reads stderr: and drives again", r.heard)
os.kill(r.process(), signal.SIGKILL)
r.listen(LATE, Robot.stands)
try:
    code = r.tool.wait(5)
except subprocess.TimeoutExpired:
    code = "hangs"
    r.tool.kill()
r.end()
say(code == 1 and r.stands(), "nobody reads stderr: the program ends without its steering process", (code, r.heard))
os.close(nobody)
os.close(full)

# The steering process ends, or hangs.
for name, stated, watchdog in ("SIGKILL", 0, "10s"), ("SIGTERM", 0, "10s"), ("SIGSTOP", 2, "10s"), ("SIGSTOP", 0.5, "400ms"):
    r = Robot("--watchdog", watchdog)
    r.drive()
    os.kill(r.process(), getattr(signal, name))
    stopped = r.listen(stated + LATE, Robot.stands)
    code, err = r.end()
    gone = "steering process is gone: the robot was stopped without it\n" in err
    say(stopped and code == 1 and (gone or name == "SIGTERM" and "told to end: the robot is stopped\n" in err),
        "steering process, %s, --watchdog %s: the program stops the robot and ends" % (name, watchdog), (stopped, code, err, r.heard))
END
timeout 120 python3 robot.py "$iris" 2> err || { sed 's/^/# /' err; echo "not ok - a robot that is told to stop"; }
