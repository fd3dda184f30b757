/**
   The host side of worker:schedule, without threads.

   A plugin sees what a real host may do: its work done after run(), or at once inside run() as
   hosts do when freewheeling. Responses are delivered after run() either way, then end_run() is
   called. One thread.
*/
#ifndef HOOKE_TOOLS_HOST_HOST_WORKER_H
#define HOOKE_TOOLS_HOST_HOST_WORKER_H

#include "tools/formats/bytes.h"

#include <lv2/core/lv2.h>
#include <lv2/worker/worker.h>
#include <stdbool.h>
#include <stdint.h>

/** When work() is called. */
typedef enum {
  HOST_WORK_AFTER_RUN, /**< Between two runs, as when playing live; the default */
  HOST_WORK_IN_RUN,    /**< Inside schedule_work(), as when freewheeling */
  HOST_WORK_REFUSED    /**< Never: schedule_work() answers that there is no space */
} HostWork;

/** A worker; all zero is one without a plugin, which refuses all work. */
typedef struct {
  const LV2_Worker_Interface* interface;
  LV2_Handle handle;
  HostWork mode;
  bool is_running;  /**< The plugin is inside run() */
  Bytes requests;   /**< Each a uint32_t size and that many bytes */
  Bytes responses;  /**< The same */
  uint32_t n_works; /**< Calls of work() so far */
  uint32_t
      n_failed; /**< Calls of work() that did not succeed, and messages lost for want of memory */
} HostWorker;

/** worker:schedule's schedule_work(); `handle` is a HostWorker. */
LV2_Worker_Status
host_worker_schedule(LV2_Worker_Schedule_Handle handle, uint32_t size, const void* data);

/** Call after every run(): do the work asked for, deliver the responses, call end_run(). */
void host_worker_finish_run(HostWorker* worker);

/** Free what is waiting. */
void host_worker_clear(HostWorker* worker);

#endif
