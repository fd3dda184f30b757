/**
   `hooke tune`: from the pitch and the decay that are wanted to masses, springs and dampers.
*/
#ifndef HOOKE_TOOLS_COMMANDS_TUNE_COMMAND_H
#define HOOKE_TOOLS_COMMANDS_TUNE_COMMAND_H

/** What `hooke help tune` says. */
extern const char tune_help[];

/**
   Run the subcommand.

   @param argc  Words in `argv`, without the program's name
   @param argv  "tune" and what follows, ended by NULL
   @return ARGS_OK; SCENE_UNSTABLE where the string has more masses than are stable, with the answer
   on stdout all the same, or where a scene has no stable tuning; ARGS_FAILURE or ARGS_USAGE after
   one line on stderr.
*/
int tune_main(int argc, char** argv);

#endif
