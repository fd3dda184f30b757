/**
   `hooke report`: the figures and numbers of the paper, drawn and computed anew.
*/
#ifndef HOOKE_TOOLS_REPORT_REPORT_H
#define HOOKE_TOOLS_REPORT_REPORT_H

/** What `hooke help report` says. */
extern const char report_help[];

/**
   Run the subcommand.

   @param argc  Words in `argv`, without the program's name
   @param argv  "report" and what follows, ended by NULL
   @return ARGS_OK, ARGS_FAILURE or ARGS_USAGE; unless ARGS_OK, one line is on stderr and nothing
   is left behind.
*/
int report_main(int argc, char** argv);

#endif
