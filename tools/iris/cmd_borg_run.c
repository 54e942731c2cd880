#include <string.h>

#include "args.h"
#include "borg_run.h"
#include "cmd_borg_run.h"
#include "complain.h"

static const char help[] =
    "usage: iris borg run SCRIPT [--transport TRANSPORT] [--robots FILES] [--world FILE] [--timeout S]\n"
    "                     [--speed N] [--seed N] [--json]\n"
    "       iris borg run [SCRIPT] --ref LINE --unit K [the same options]\n"
    "       iris borg run SCRIPT --serve --transport mqtt://HOST[:PORT][/TOPIC] [--timeout S]\n\n"
    "Runs a script of BorgCode on a team of robots, each a process of its own that hears the others over a\n"
    "network: all of the script's robots on this machine, or with --ref and --unit one robot, and others on\n"
    "other machines. The robots are simulated, in a world of which each has its own copy.\n\n"
    "  --transport udp[:GROUP:PORT[,INTERFACE]]\n"
    "                   multicast on one network (default: udp, which is udp:239.255.73.82:7382); INTERFACE "
    "such\n"
    "                   as wlan0, or lo for this machine alone; without one, where the system's routes lead\n"
    "  --transport mqtt://HOST[:PORT][/TOPIC]\n"
    "                   through a broker (port 1883, topic iris), which keeps the robots' chunks: robots "
    "that are\n"
    "                   started with --ref and --unit need no SCRIPT then, at any time of the mission\n"
    "  --ref LINE       the robot's group, by its line in the script\n"
    "  --unit K         which robot of its group, from 1\n"
    "  --serve          starts no robot: the broker keeps the chunks until Ctrl-C\n"
    "  --robots FILES   robot files with commas between, one robot each in the order of the script's lines,\n"
    "                   over and over (default: a small robot with two wheels)\n"
    "  --world FILE     walls, painted lines, objects, and where robots start (default: a room of 6 by 4 "
    "meters)\n"
    "  --timeout S      seconds until a time-out where the script names none (default 60)\n"
    "  --speed N        simulated seconds in one second, 1 to 20 (default 1); the same for all of a team\n"
    "  --seed N         of the noise of sensors (default 1)\n"
    "  --json           one JSON object at the end: robots, each with unit (of its group), ref (its group's\n"
    "                   line), state, states (all that it went through), x_mm, y_mm; else a line whenever a\n"
    "                   robot's state changes, and one for each robot at the end\n\n"
    "A robot ends once its time is out and it stands; Ctrl-C stops all.\n\n"
    "example: iris borg run examples/scripts/explore.borg --transport udp:239.255.73.82:7382,lo --timeout "
    "30\n";

static int is_whole(const borg_run_wishes *wishes, const arguments *args)
{
    if ((wishes->ref == 0) != (wishes->unit == 0)) {
        complain(wishes->ref ? "--ref" : "--unit", "--ref and --unit name one robot together");
        return 0;
    }
    if (wishes->serve && (wishes->ref || wishes->json)) {
        complain("--serve", "starts no robot: not with %s", wishes->ref ? "--ref and --unit" : "--json");
        return 0;
    }
    if (args->operand_count > 1 || (args->operand_count == 0 && wishes->ref == 0)) {
        complain(NULL, "run: one script is needed (see iris borg run --help)");
        return 0;
    }
    return 1;
}

int cmd_borg_run(int argc, char **argv)
{
    borg_run_wishes wishes = {.timeout_s = 60, .seed = 1, .speed = 1};
    const char *ref = NULL, *unit = NULL, *timeout = NULL, *seed = NULL, *speed = NULL;
    const args_option options[] = {{"transport", 0, NULL, &wishes.transport},
                                   {"ref", 0, NULL, &ref},
                                   {"unit", 0, NULL, &unit},
                                   {"robots", 0, NULL, &wishes.robots},
                                   {"world", 0, NULL, &wishes.world},
                                   {"timeout", 0, NULL, &timeout},
                                   {"speed", 0, NULL, &speed},
                                   {"seed", 0, NULL, &seed},
                                   {"serve", 0, &wishes.serve, NULL},
                                   {"json", 0, &wishes.json, NULL}};
    arguments args = {.help = help, .options = options, .option_count = sizeof options / sizeof options[0]};
    const int code = args_parse(&args, argc, argv);
    if (code != ARGS_GO) {
        return code;
    }
    const args_whole numbers[] = {{"--ref", ref, &wishes.ref, 1, 65535},
                                  {"--unit", unit, &wishes.unit, 1, 255},
                                  {"--timeout", timeout, &wishes.timeout_s, 1, 65535},
                                  {"--speed", speed, &wishes.speed, 1, 20},
                                  {"--seed", seed, &wishes.seed, 0, INT32_MAX}};
    if (!args_wholes(numbers, sizeof numbers / sizeof numbers[0]) || !is_whole(&wishes, &args)) {
        return EXIT_BAD_CALL;
    }
    wishes.script = args.operand_count > 0 ? args.operands[0] : NULL;
    return borg_run(&wishes);
}
