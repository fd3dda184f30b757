#include "tools/commands/score_render.h"

#include "tools/host/setting.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { PLACE_SIZE = 4200 };

static const char ENDING[] = ".score";

/* Messages begin with where in the score it stands, as those of its reader do. */
static Args args_at(const Args* args, const char* path, uint32_t line, char place[PLACE_SIZE]) {
  (void)snprintf(place, PLACE_SIZE, "%s: %s:%lu", args->command, path, (unsigned long)line);
  return (Args){.command = place};
}

static bool set(const Args* args, const char* path, const ScoreSetting* setting, Host* host) {
  char place[PLACE_SIZE];
  char number[32];
  const Args at = args_at(args, path, setting->line, place);
  (void)snprintf(number, sizeof(number), "%.9g", setting->value);
  return setting_set(&at, host, setting->symbol, setting->text ? setting->text : number);
}

static PlayEvent event(const void* song, size_t i) {
  const ScoreEvent* const event = &((const Score*)song)->events[i];
  return (PlayEvent){event->time_s, &event->event, sizeof(event->event)};
}

bool score_render_is_score(const char* path) {
  const char* const ending = strrchr(path, '.');
  return ending && !strcasecmp(ending, ENDING);
}

bool score_render_is_playable(const Args* args, Host* host) {
  LilvNode* const type = lilv_new_uri(host_world(host), GUITAR_EVENT_URI);
  const LilvPlugin* const plugin = host_plugin(host);
  bool is_playable = false;
  for (uint32_t i = 0; type && i < lilv_plugin_get_num_ports(plugin); ++i) {
    const LilvPort* const port = lilv_plugin_get_port_by_index(plugin, i);
    is_playable = is_playable || lilv_port_supports_event(plugin, port, type);
  }
  lilv_node_free(type);
  if (!is_playable) {
    args_fail(args, 0, "found <%s>, expected a plugin that plays scores, as <%s>",
              lilv_node_as_uri(lilv_plugin_get_uri(plugin)), SCORE_RENDER_PLUGIN);
  }
  return is_playable;
}

bool score_render_load_preset(const Args* args, const char* path, const Score* score, Host* host) {
  char place[PLACE_SIZE];
  if (!score->preset || host_preset(host, score->preset)) {
    return true;
  }
  const Args at = args_at(args, path, score->preset_line, place);
  args_fail(&at, 0, "%s; --list-presets names them", host_error(host));
  return false;
}

bool score_render_set(const Args* args, const char* path, const Score* score, Host* host) {
  for (size_t i = 0; i < score->n_settings; ++i) {
    if (!set(args, path, &score->settings[i], host)) {
      return false;
    }
  }
  return true;
}

PlaySong score_render_song(const Score* score) {
  return (PlaySong){GUITAR_EVENT_URI, score, score->n_events, score->duration_s, event};
}
