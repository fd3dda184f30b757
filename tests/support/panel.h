/** What the Turtle tells a host that draws a panel by itself. */
#ifndef HOOKE_TESTS_SUPPORT_PANEL_H
#define HOOKE_TESTS_SUPPORT_PANEL_H

#include "tools/host/host.h"

#include <stdbool.h>
#include <stdint.h>

/** An object of a statement on a port, or on a node; NULL if there is none; to be freed. */
LilvNode* panel_get(Host* host, uint32_t port, const char* predicate);
LilvNode* panel_of(Host* host, const LilvNode* subject, const char* predicate);

/** Whether a port has a lv2:portProperty. */
bool panel_has(Host* host, uint32_t port, const char* property);

/** Whether it is a control or a meter that a panel shows. */
bool panel_shows(Host* host, uint32_t port);

/** Check each shown port of both plugins. */
void panel_check_all(void (*check)(Host* host, uint32_t port));

#endif
