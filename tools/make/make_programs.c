/* Writes the presets of a bundle as C, for the plugins to look them up by bank and program:

       make_programs BUNDLE OUT

   It runs while Hooke is built, so that the Turtle stays the only place where presets are said. */
#include <lilv/lilv.h>
#include <lv2/core/lv2.h>
#include <lv2/presets/presets.h>

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HOOKE "urn:hooke:"

enum { MOST_PORTS = 64, MOST_BANKS = 128, BANK_SIZE = 128 };

typedef struct {
  bool is_there;
  char label[128];
  uint64_t ports;           /* The sum of 2^index over those that it sets */
  float values[MOST_PORTS]; /* By port index */
} Program;

/* Programs of bank b begin at b * BANK_SIZE. */
typedef struct {
  LilvWorld* world;
  const LilvPlugin* plugin;
  Program* programs;
} Maker;

static _Noreturn void fail(const char* what, const char* of) {
  (void)fprintf(stderr, "make_programs: %s: %s\n", of, what);
  exit(1);
}

/* The one object of a statement, NULL if there is none. */
static LilvNode* object(const Maker* maker, const LilvNode* subject, const char* predicate) {
  LilvNode* const key = lilv_new_uri(maker->world, predicate);
  LilvNode* const node = lilv_world_get(maker->world, subject, key, NULL);
  lilv_node_free(key);
  return node;
}

static uint32_t number(const Maker* maker, const LilvNode* subject, const char* predicate) {
  LilvNode* const node = object(maker, subject, predicate);
  if (!node || !lilv_node_is_int(node) || lilv_node_as_int(node) < 0 ||
      lilv_node_as_int(node) >= BANK_SIZE) {
    fail("it has no number from 0 to 127, or more than one", lilv_node_as_string(subject));
  }
  const uint32_t value = (uint32_t)lilv_node_as_int(node);
  lilv_node_free(node);
  return value;
}

static uint32_t bank_of(const Maker* maker, const LilvNode* preset) {
  LilvNode* const bank = object(maker, preset, LV2_PRESETS__bank);
  if (!bank) {
    fail("it is in no bank", lilv_node_as_string(preset));
  }
  const uint32_t value = number(maker, bank, HOOKE "bank");
  lilv_node_free(bank);
  return value;
}

static void read_port(const Maker* maker, const LilvNode* node, Program* program) {
  LilvNode* const symbol = object(maker, node, LV2_CORE__symbol);
  LilvNode* const value = object(maker, node, LV2_PRESETS__value);
  const LilvPort* const port =
      symbol ? lilv_plugin_get_port_by_symbol(maker->plugin, symbol) : NULL;
  if (!port || !value) {
    fail("it sets a port that there is not, or not to a value", program->label);
  }
  const uint32_t index = lilv_port_get_index(maker->plugin, port);
  if (index >= MOST_PORTS || program->ports >> index & 1) {
    fail("it sets a port twice, or one of too high an index", program->label);
  }
  program->ports |= UINT64_C(1) << index;
  program->values[index] = lilv_node_as_float(value);
  lilv_node_free(symbol);
  lilv_node_free(value);
}

static void read_ports(const Maker* maker, const LilvNode* preset, Program* program) {
  LilvNode* const key = lilv_new_uri(maker->world, LV2_CORE__port);
  LilvNodes* const ports = lilv_world_find_nodes(maker->world, preset, key, NULL);
  LILV_FOREACH(nodes, i, ports) {
    read_port(maker, lilv_nodes_get(ports, i), program);
  }
  lilv_nodes_free(ports);
  lilv_node_free(key);
}

static void read_preset(const Maker* maker, const LilvNode* preset) {
  (void)lilv_world_load_resource(maker->world, preset);
  LilvNode* const label = object(maker, preset, LILV_NS_RDFS "label");
  const uint32_t bank = bank_of(maker, preset);
  Program* const program =
      &maker->programs[bank * BANK_SIZE + number(maker, preset, HOOKE "program")];
  if (program->is_there) {
    fail("another has its number in its bank", lilv_node_as_string(preset));
  }
  program->is_there = true;
  (void)snprintf(program->label, sizeof(program->label), "%s", lilv_node_as_string(label));
  read_ports(maker, preset, program);
  lilv_node_free(label);
}

static void read_presets(const Maker* maker) {
  LilvNode* const type = lilv_new_uri(maker->world, LV2_PRESETS__Preset);
  LilvNodes* const presets = lilv_plugin_get_related(maker->plugin, type);
  LILV_FOREACH(nodes, i, presets) {
    read_preset(maker, lilv_nodes_get(presets, i));
  }
  lilv_nodes_free(presets);
  lilv_node_free(type);
}

/* How many of a bank there are from its first on; those after a gap are a fault. */
static uint32_t count_programs(const Program* bank) {
  uint32_t n = 0;
  while (n < BANK_SIZE && bank[n].is_there) {
    ++n;
  }
  for (uint32_t i = n; i < BANK_SIZE; ++i) {
    if (bank[i].is_there) {
      fail("there is a gap before its number", bank[i].label);
    }
  }
  return n;
}

static void write_program(FILE* out, const Program* program, uint64_t ports) {
  if (program->ports != ports) {
    fail("it does not set the same ports as the first", program->label);
  }
  (void)fprintf(out, "    /* %s */", program->label);
  const char* before = "\n    ";
  for (uint32_t i = 0; i < MOST_PORTS; ++i) {
    if (ports >> i & 1) {
      (void)fprintf(out, "%s%.9ef,", before, (double)program->values[i]);
      before = " ";
    }
  }
  (void)fprintf(out, "\n");
}

static uint32_t write_ports(FILE* out, const char* name, uint64_t ports) {
  uint32_t n = 0;
  (void)fprintf(out, "static const uint32_t %s_ports[] = {", name);
  for (uint32_t i = 0; i < MOST_PORTS; ++i) {
    if (ports >> i & 1) {
      (void)fprintf(out, "%s%u", n++ ? ", " : "", i);
    }
  }
  (void)fprintf(out, "};\n");
  return n;
}

static void write_table(FILE* out, const Program* programs, const char* name) {
  uint32_t firsts[MOST_BANKS + 1] = {0};
  uint32_t n_banks = 0;
  const uint32_t n_ports = write_ports(out, name, programs->ports);
  (void)fprintf(out, "static const float %s_values[] = {\n", name);
  for (uint32_t b = 0; b < MOST_BANKS; ++b) {
    const uint32_t n = count_programs(&programs[b * BANK_SIZE]);
    for (uint32_t i = 0; i < n; ++i) {
      write_program(out, &programs[b * BANK_SIZE + i], programs->ports);
    }
    firsts[b + 1] = firsts[b] + n;
    if (n && b > n_banks) {
      fail("there is a gap before its bank", programs[b * BANK_SIZE].label);
    }
    n_banks += n > 0;
  }
  (void)fprintf(out, "};\nstatic const uint32_t %s_firsts[] = {", name);
  for (uint32_t b = 0; b <= n_banks; ++b) {
    (void)fprintf(out, "%s%u", b ? ", " : "", firsts[b]);
  }
  (void)fprintf(out, "};\nconst ProgramTable %s_programs = {%u, %s_ports, %u, %s_firsts, ", name,
                n_ports, name, n_banks, name);
  (void)fprintf(out, "%s_values};\n\n", name);
}

static void write_plugin(FILE* out, LilvWorld* world, const LilvPlugin* plugin) {
  const char* const uri = lilv_node_as_uri(lilv_plugin_get_uri(plugin));
  Maker maker = {world, plugin, calloc((size_t)MOST_BANKS * BANK_SIZE, sizeof(Program))};
  if (!maker.programs || strncmp(uri, HOOKE, strlen(HOOKE)) != 0) {
    fail("out of memory, or a plugin of no name of ours", uri);
  }
  read_presets(&maker);
  write_table(out, maker.programs, uri + strlen(HOOKE));
  free(maker.programs);
}

static void write_bundle(FILE* out, LilvWorld* world) {
  const LilvPlugins* const plugins = lilv_world_get_all_plugins(world);
  (void)fprintf(out, "/* Made from presets/ by tools/make/make_programs.c. */\n"
                     "#include \"plugin/programs.h\"\n\n");
  LILV_FOREACH(plugins, i, plugins) {
    write_plugin(out, world, lilv_plugins_get(plugins, i));
  }
}

int main(int argc, char** argv) {
  char path[4096];
  if (argc != 3 || snprintf(path, sizeof(path), "%s/", argv[1]) >= (int)sizeof(path)) {
    fail("expected a bundle and a file to write", "usage");
  }
  LilvWorld* const world = lilv_world_new();
  FILE* const out = fopen(argv[2], "w");
  LilvNode* const bundle = world ? lilv_new_file_uri(world, NULL, path) : NULL;
  if (!out || !bundle) {
    fail("it cannot be written", argv[2]);
  }
  lilv_world_load_bundle(world, bundle);
  write_bundle(out, world);
  lilv_node_free(bundle);
  lilv_world_free(world);
  if (fclose(out)) {
    fail("it cannot be written", argv[2]);
  }
  return 0;
}
