/** What is used of JACK, looked up in its library when it runs: to build the tests no more is
 * needed than to play them. */
#ifndef HOOKE_TESTS_HOSTS_JACK_H
#define HOOKE_TESTS_HOSTS_JACK_H

#include <stddef.h>
#include <stdint.h>

typedef struct JackClient JackClient;
typedef struct JackPort JackPort;

typedef int (*JackProcess)(uint32_t n_frames, void* data);
typedef int (*JackXrun)(void* data);

#define JACK_AUDIO "32 bit float mono audio"
#define JACK_MIDI "8 bit raw midi"

enum { JACK_NO_START_SERVER = 1, JACK_INPUT = 1, JACK_OUTPUT = 2 };

/* Name, what it returns, and what it takes. */
#define JACK_FUNCTIONS(X)                                                                          \
  X(client_open, JackClient*, (const char* name, int options, int* status, ...))                   \
  X(client_close, int, (JackClient * client))                                                      \
  X(activate, int, (JackClient * client))                                                          \
  X(deactivate, int, (JackClient * client))                                                        \
  X(get_sample_rate, uint32_t, (JackClient * client))                                              \
  X(set_freewheel, int, (JackClient * client, int is_on))                                          \
  X(set_process_callback, int, (JackClient * client, JackProcess process, void* data))             \
  X(set_xrun_callback, int, (JackClient * client, JackXrun xrun, void* data))                      \
  X(port_register, JackPort*,                                                                      \
    (JackClient * client, const char* name, const char* type, unsigned long flags,                 \
     unsigned long size))                                                                          \
  X(port_name, const char*, (const JackPort* port))                                                \
  X(port_get_buffer, void*, (JackPort * port, uint32_t n_frames))                                  \
  X(get_ports, const char**,                                                                       \
    (JackClient * client, const char* name, const char* type, unsigned long flags))                \
  X(connect, int, (JackClient * client, const char* from, const char* to))                         \
  X(midi_clear_buffer, void, (void* buffer))                                                       \
  X(midi_event_write, int, (void* buffer, uint32_t time, const uint8_t* data, size_t size))

typedef struct {
#define X(name, type, arguments) type(*name) arguments;
  JACK_FUNCTIONS(X)
#undef X
} Jack;

/** Find them. @return 0, or −1 and one line on stderr */
int jack_find(Jack* jack);

#endif
