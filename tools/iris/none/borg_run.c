/* iris borg run where the library has no networks. */
#include "../borg_run.h"

#include "../complain.h"

int borg_run(const borg_run_wishes *wishes)
{
    (void)wishes;
    complain("run", "this build of iris has no networks; iris swarm simulates a team in one program");
    return EXIT_BAD_DATA;
}
