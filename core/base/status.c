#include "core/base/status.h"

#define STATUS_TEXT(name, text) text,
static const char* const texts[] = {STATUS_LIST(STATUS_TEXT)};
#undef STATUS_TEXT

const char* status_text(Status status) {
  return (unsigned)status < (unsigned)STATUS_COUNT ? texts[status] : "unknown status";
}
