/**
   `hooke render`: a MIDI file, a score or a scene in, a sound file out.
*/
#ifndef HOOKE_TOOLS_COMMANDS_RENDER_H
#define HOOKE_TOOLS_COMMANDS_RENDER_H

/** What `hooke help render` says. */
extern const char render_help[];

/**
   Run the subcommand.

   @param argc  Words in `argv`, without the program's name
   @param argv  "render" and what follows, ended by NULL
   @return ARGS_OK, ARGS_FAILURE, ARGS_USAGE or SCENE_UNSTABLE (tools/formats/scene.h); unless
   ARGS_OK, one line is on stderr and no file is left behind.
*/
int render_main(int argc, char** argv);

#endif
