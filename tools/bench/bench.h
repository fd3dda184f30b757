/**
   `hooke bench`: what strings, the harp and other instruments cost on this machine.
*/
#ifndef HOOKE_TOOLS_BENCH_BENCH_H
#define HOOKE_TOOLS_BENCH_BENCH_H

/** What `hooke help bench` says. */
extern const char bench_help[];

/**
   Run the subcommand.

   @param argc  Words in `argv`, without the program's name
   @param argv  "bench" and what follows, ended by NULL
   @return ARGS_OK, ARGS_FAILURE or ARGS_USAGE; unless ARGS_OK, one line is on stderr
*/
int bench_main(int argc, char** argv);

#endif
