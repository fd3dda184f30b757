#include "tools/formats/scene_body.h"

#include "core/bank/body_read.h"
#include "tools/formats/scene_part.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static const TextRange COLUMNS = {"a whole number of columns from 1 to 256", 1, SCENE_MOST_COLUMNS,
                                  true};
static const TextRange ROWS = {"a whole number of rows from 1 to 256", 1, SCENE_MOST_COLUMNS, true};
static const TextRange SIZE = {"a size from 0.001 to 100 m", 0.001, 100.0, false};
static const TextRange DENSITY = {"a density from 1e-6 to 1e6 kg/m²", 1e-6, 1e6, false};
static const TextRange PLATE_BENDING = {"a bending stiffness from 1e-9 to 1e9 N m", 1e-9, 1e9,
                                        false};
static const TextRange BAR_BENDING = {"a bending stiffness from 0 to 1e9 N m²", 0.0, 1e9, false};
static const TextRange TENSION = {"a tension from 1e-3 to 1e9 N/m", 1e-3, 1e9, false};
static const TextRange WIDTH = {"a share of the width from 0 to 1", 0.0, 1.0, false};
static const TextRange KG = {"a mass above 0 kg", DBL_MIN, DBL_MAX, false};
static const TextRange MORE_KG = {"a mass from 0 to 1e6 kg", 0.0, 1e6, false};
static const TextRange STIFFNESS = {"a stiffness from 0 N/m up", 0.0, DBL_MAX, false};
static const TextRange AREA = {"an area from 1e-9 to 1e4 m²", 1e-9, 1e4, false};
static const TextRange VOLUME = {"a volume from 1e-9 to 1e6 m³", 1e-9, 1e6, false};
static const TextRange WEIGHT = {"a weight from -1000 to 1000", -1000.0, 1000.0, false};
static const TextRange GAIN = {"a gain from -1000 to 1000", -1000.0, 1000.0, false};
static const TextRange HZ = {"a frequency from 1 to 100000 Hz", 1.0, 1e5, false};
static const TextRange Q = {"a Q from 0.51 to 1000000", 0.51, 1e6, false};

/* γ p of air [Pa]: how it withstands compression while no heat flows. */
static const double AIR_PA = 1.4 * 101325.0;

/* Levers */

static bool take_lever(SceneReader* reader, uint32_t n, const double* weight) {
  Text* const text = &reader->text;
  char quote[TEXT_QUOTE_SIZE];
  NetworkTerm term[4];
  double stiffness = 0.0;
  for (uint32_t i = 0; i < n; ++i) {
    term[i].weight = weight[i];
    if (!scene_point(reader, false, &term[i].point, quote)) {
      return false;
    }
    for (uint32_t j = 0; j < i; ++j) {
      if (term[j].point == term[i].point) {
        return text_fail_at(text, text->line, "found %s again, expected another point", quote);
      }
    }
  }
  return text_number(text, &STIFFNESS, &stiffness) && text_end(text) &&
         scene_done(reader, network_add_lever(reader->network, stiffness, n, term));
}

bool scene_take_bend(SceneReader* reader) {
  static const double weights[] = {1.0, -2.0, 1.0};
  return take_lever(reader, 3, weights);
}

bool scene_take_twist(SceneReader* reader) {
  static const double weights[] = {1.0, -1.0, -1.0, 1.0};
  return take_lever(reader, 4, weights);
}

/* Sheets */

static bool take_grid(SceneReader* reader, SceneSheet* sheet) {
  Text* const text = &reader->text;
  double columns = 0.0;
  double rows = 0.0;
  if (!text_number(text, &COLUMNS, &columns) || !text_number(text, &ROWS, &rows) ||
      !text_keyword(text, "size") || !text_number(text, &SIZE, &sheet->size_m[0]) ||
      !text_number(text, &SIZE, &sheet->size_m[1]) || !text_keyword(text, "density") ||
      !text_number(text, &DENSITY, &sheet->density)) {
    return false;
  }
  sheet->n[0] = (uint32_t)columns;
  sheet->n[1] = (uint32_t)rows;
  return true;
}

static bool take_edge(SceneReader* reader, SceneSheet* sheet) {
  static const char* const words[] = {
      [SCENE_FREE] = "free", [SCENE_HINGED] = "hinged", [SCENE_CLAMPED] = "clamped"};
  Text* const text = &reader->text;
  if (!text_keyword(text, "edge")) {
    return false;
  }
  const char* const word = text_word(text);
  for (unsigned edge = SCENE_FREE; word && edge <= SCENE_CLAMPED; ++edge) {
    if (!strcmp(word, words[edge])) {
      sheet->edge = (SceneEdge)edge;
      return true;
    }
  }
  return text_fail(text, word, "free, hinged or clamped");
}

static bool take_widths(SceneReader* reader, SceneSheet* sheet) {
  Text* const text = &reader->text;
  for (char* word = text_word(text); word; word = text_word(text)) {
    if (sheet->n_widths == SCENE_MOST_WIDTHS) {
      return text_fail(text, word, "32 widths at most");
    }
    if (!text_is_number(word, &WIDTH, &sheet->widths[sheet->n_widths++])) {
      return text_fail(text, word, WIDTH.expected);
    }
  }
  return sheet->n_widths > 0 || text_fail(text, NULL, WIDTH.expected);
}

static bool take_shape(SceneReader* reader, SceneSheet* sheet) {
  Text* const text = &reader->text;
  const char* const word = text_word(text);
  if (word && !strcmp(word, "round")) {
    sheet->is_round = true;
    return text_end(text);
  }
  if (word && !strcmp(word, "outline")) {
    return take_widths(reader, sheet);
  }
  return !word || text_fail(text, word, "round, outline or the end of the line");
}

static bool add_sheet(SceneReader* reader, SceneName name, const SceneSheet* sheet) {
  Text* const text = &reader->text;
  const Status status = scene_mesh_add(reader->network, sheet, &name.mesh);
  if (status == STATUS_EMPTY) {
    return text_fail_at(text, text->line,
                        "found an outline that no mass is inside of, expected a wider one");
  }
  name.first = name.mesh.first;
  return scene_done(reader, status) && scene_declare(reader, name);
}

bool scene_take_plate(SceneReader* reader) {
  Text* const text = &reader->text;
  SceneName name = {.kind = SCENE_SHEET};
  SceneSheet sheet = {.edge = SCENE_FREE};
  return scene_new_name(reader, &name) && take_grid(reader, &sheet) &&
         text_keyword(text, "bending") && text_number(text, &PLATE_BENDING, &sheet.bending[0]) &&
         text_number(text, &PLATE_BENDING, &sheet.bending[1]) && take_edge(reader, &sheet) &&
         take_shape(reader, &sheet) && add_sheet(reader, name, &sheet);
}

bool scene_take_membrane(SceneReader* reader) {
  Text* const text = &reader->text;
  SceneName name = {.kind = SCENE_SHEET};
  SceneSheet sheet = {.edge = SCENE_HINGED};
  return scene_new_name(reader, &name) && take_grid(reader, &sheet) &&
         text_keyword(text, "tension") && text_number(text, &TENSION, &sheet.tension) &&
         take_shape(reader, &sheet) && add_sheet(reader, name, &sheet);
}

/* The sheet whose mass a point is, or NULL. */
static const SceneName* sheet_of(const SceneReader* reader, uint32_t point) {
  const SceneName* const names = (const SceneName*)(const void*)reader->names.data;
  const size_t n_names = reader->names.size / sizeof(SceneName);
  for (size_t i = 0; i < n_names; ++i) {
    const SceneMesh* const mesh = &names[i].mesh;
    if (names[i].kind == SCENE_SHEET && point >= mesh->first &&
        point - mesh->first < mesh->n[0] * mesh->n[1]) {
      return &names[i];
    }
  }
  return NULL;
}

bool scene_take_brace(SceneReader* reader) {
  Text* const text = &reader->text;
  uint32_t from = 0;
  uint32_t to = 0;
  double mass_kg = 0.0;
  double bending = 0.0;
  if (!scene_mass(reader, &from) || !scene_mass(reader, &to) || !text_keyword(text, "mass") ||
      !text_number(text, &MORE_KG, &mass_kg) || !text_keyword(text, "bending") ||
      !text_number(text, &BAR_BENDING, &bending) || !text_end(text)) {
    return false;
  }
  const SceneName* const sheet = sheet_of(reader, from);
  Status status = STATUS_BAD_ARGUMENT;
  if (sheet && sheet == sheet_of(reader, to)) {
    status = scene_mesh_brace(reader->network, &sheet->mesh, from, to, mass_kg, bending);
  }
  if (status == STATUS_BAD_ARGUMENT) {
    return text_fail_at(text, text->line,
                        "found a brace that does not lie on a plate, expected two masses of one "
                        "row, column or diagonal and none missing between them");
  }
  return scene_done(reader, status);
}

/* Air */

static bool append_term(SceneReader* reader, Bytes* terms, NetworkTerm term) {
  return bytes_append(terms, &term, sizeof(term)) || text_fail_memory(&reader->text);
}

/* The masses of a wall, each by the area that it has of it. */
static bool append_wall(SceneReader* reader, Bytes* terms, const SceneMesh* mesh) {
  const uint32_t end = mesh->first + mesh->n[0] * mesh->n[1];
  bool is_done = true;
  for (uint32_t point = mesh->first; point < end && is_done; ++point) {
    if (!reader->network->is_ground[point]) {
      is_done =
          append_term(reader, terms, (NetworkTerm){point, mesh->spacing_m[0] * mesh->spacing_m[1]});
    }
  }
  return is_done;
}

static bool take_walls(SceneReader* reader, Bytes* terms) {
  Text* const text = &reader->text;
  const SceneName* walls[8];
  size_t n_walls = 0;
  for (char* word = text_word(text); word; word = text_word(text)) {
    const SceneName* const wall = scene_find(reader, word);
    bool is_new = wall && wall->kind == SCENE_SHEET && n_walls < sizeof(walls) / sizeof(walls[0]);
    for (size_t i = 0; i < n_walls; ++i) {
      is_new &= walls[i] != wall;
    }
    if (!is_new) {
      return text_fail(text, word, "a plate or membrane declared above, each once and 8 at most");
    }
    walls[n_walls++] = wall;
    if (!append_wall(reader, terms, &wall->mesh)) {
      return false;
    }
  }
  return n_walls > 0 || text_fail(text, NULL, "a plate or membrane declared above");
}

static bool take_air(SceneReader* reader, Bytes* terms) {
  Text* const text = &reader->text;
  SceneName name = {.kind = SCENE_AIR};
  double mass_kg = 0.0;
  double volume_m3 = 0.0;
  if (!scene_new_name(reader, &name) || !text_keyword(text, "mass") ||
      !text_number(text, &KG, &mass_kg) || !text_keyword(text, "area") ||
      !text_number(text, &AREA, &name.area_m2) || !text_keyword(text, "volume") ||
      !text_number(text, &VOLUME, &volume_m3) || !text_keyword(text, "walls") ||
      !take_walls(reader, terms) ||
      !scene_done(reader, network_add_mass(reader->network, mass_kg, &name.first)) ||
      !append_term(reader, terms, (NetworkTerm){name.first, name.area_m2})) {
    return false;
  }
  return scene_done(reader, network_add_lever(reader->network, AIR_PA / volume_m3,
                                              (uint32_t)(terms->size / sizeof(NetworkTerm)),
                                              (const NetworkTerm*)(const void*)terms->data)) &&
         scene_declare(reader, name);
}

bool scene_take_air(SceneReader* reader) {
  Bytes terms = {0};
  const bool is_taken = take_air(reader, &terms);
  bytes_clear(&terms);
  return is_taken;
}

/* What is heard */

bool scene_take_bridge(SceneReader* reader) {
  ScenePickup pull = {0};
  return scene_mass(reader, &pull.point) && text_number(&reader->text, &WEIGHT, &pull.gain) &&
         text_end(&reader->text) &&
         (bytes_append(&reader->bridge, &pull, sizeof(pull)) || text_fail_memory(&reader->text));
}

static bool append_radiator(SceneReader* reader, SceneRadiator radiator) {
  return bytes_append(&reader->radiators, &radiator, sizeof(radiator)) ||
         text_fail_memory(&reader->text);
}

static bool append_sheet(SceneReader* reader, const SceneMesh* mesh, double gain) {
  const uint32_t end = mesh->first + mesh->n[0] * mesh->n[1];
  bool is_done = true;
  for (uint32_t point = mesh->first; point < end && is_done; ++point) {
    if (!reader->network->is_ground[point]) {
      SceneRadiator radiator = {.point = point,
                                .area_m2 = gain * mesh->spacing_m[0] * mesh->spacing_m[1]};
      scene_mesh_place(mesh, point, radiator.place_m);
      is_done = append_radiator(reader, radiator);
    }
  }
  return is_done;
}

bool scene_take_radiate(SceneReader* reader) {
  Text* const text = &reader->text;
  char* const word = text_word(text);
  const SceneName* const name = word ? scene_find(reader, word) : NULL;
  double gain = 0.0;
  if (!name || (name->kind != SCENE_SHEET && name->kind != SCENE_AIR)) {
    return text_fail(text, word, "a plate, membrane or air declared above");
  }
  if (!text_number(text, &GAIN, &gain) || !text_end(text)) {
    return false;
  }
  return name->kind == SCENE_SHEET
             ? append_sheet(reader, &name->mesh, gain)
             : append_radiator(
                   reader, (SceneRadiator){.point = name->first, .area_m2 = gain * name->area_m2});
}

bool scene_take_loss(SceneReader* reader) {
  Text* const text = &reader->text;
  const size_t n_losses = reader->losses.size / sizeof(SceneLoss);
  const SceneLoss* const losses = (const SceneLoss*)(const void*)reader->losses.data;
  SceneLoss loss = {0};
  if (!text_number(text, &HZ, &loss.f0_hz) || !text_number(text, &Q, &loss.q) || !text_end(text)) {
    return false;
  }
  if (n_losses > 0 && !(loss.f0_hz > losses[n_losses - 1].f0_hz)) {
    return text_fail_at(text, text->line, "found %g Hz after %g Hz, expected a higher one",
                        loss.f0_hz, losses[n_losses - 1].f0_hz);
  }
  return bytes_append(&reader->losses, &loss, sizeof(loss)) || text_fail_memory(text);
}

/* As in a table (core/bank/body_read.h), whose reader takes whole lines. */
bool scene_take_above(SceneReader* reader) {
  static const char word[] = "above ";
  Text* const text = &reader->text;
  Bytes line = {0};
  Body body;
  BodyError error;
  if (!bytes_append(&line, word, strlen(word)) ||
      !bytes_append(&line, text->at, strlen(text->at))) {
    bytes_clear(&line);
    return text_fail_memory(text);
  }
  const Status status = body_read_modes((const char*)line.data, line.size, &body, &error);
  bytes_clear(&line);
  if (status) {
    return text_fail_at(text, text->line, "found %s, expected %s", error.found, error.expected);
  }
  return bytes_append(&reader->more, body.modes, body.n_modes * sizeof(BodyMode)) ||
         text_fail_memory(text);
}
