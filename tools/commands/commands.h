/**
   The subcommands of `hooke` that are here: what `hooke help NAME` says of each, and what runs it.

   A NAME_main() takes the words of the command line from the subcommand's own on, and how many they
   are. Unless it returns ARGS_OK, or ARGS_UNSTABLE with an answer, one line is on stderr.
*/
#ifndef HOOKE_TOOLS_COMMANDS_COMMANDS_H
#define HOOKE_TOOLS_COMMANDS_COMMANDS_H

/**
   `hooke render`: a MIDI file, a score or a scene in, a sound file out.

   @return ARGS_OK, ARGS_FAILURE, ARGS_USAGE, or ARGS_UNSTABLE for a scene that is; unless ARGS_OK,
   no file is left behind.
*/
int render_main(int argc, char** argv);
extern const char render_help[];

/**
   `hooke modes`: what a scene's network will sound like, and whether it will be stable.

   @return ARGS_OK where the network is stable, ARGS_UNSTABLE where it is not, with the modes on
   stdout; ARGS_FAILURE or ARGS_USAGE.
*/
int modes_main(int argc, char** argv);
extern const char modes_help[];

/**
   `hooke body`: the modes of an instrument's body, and a table of them.

   @return ARGS_OK, ARGS_FAILURE or ARGS_USAGE; unless ARGS_OK, no table is left behind.
*/
int body_main(int argc, char** argv);
extern const char body_help[];

/**
   `hooke tune`: from the pitch and the decay that are wanted to masses, springs and dampers.

   @return ARGS_OK; ARGS_UNSTABLE where the string has more masses than are stable, with the answer
   on stdout all the same, or where a scene has no stable tuning; ARGS_FAILURE or ARGS_USAGE.
*/
int tune_main(int argc, char** argv);
extern const char tune_help[];

#endif
