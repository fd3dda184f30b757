/**
   `hooke modes`: what a scene's network will sound like, and whether it will be stable.
*/
#ifndef HOOKE_TOOLS_COMMANDS_MODES_COMMAND_H
#define HOOKE_TOOLS_COMMANDS_MODES_COMMAND_H

/** What `hooke help modes` says. */
extern const char modes_help[];

/**
   Run the subcommand.

   @param argc  Words in `argv`, without the program's name
   @param argv  "modes" and what follows, ended by NULL
   @return ARGS_OK where the network is stable, SCENE_UNSTABLE where it is not, with the modes on
   stdout; ARGS_FAILURE or ARGS_USAGE after one line on stderr.
*/
int modes_main(int argc, char** argv);

#endif
