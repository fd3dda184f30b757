#include "tools/host/host_worker.h"

#include <string.h>

static bool queue_push(Bytes* queue, uint32_t size, const void* data) {
  const size_t old_size = queue->size;
  if (bytes_append(queue, &size, sizeof(size)) && bytes_append(queue, data, size)) {
    return true;
  }
  queue->size = old_size;
  return false;
}

/* Take the whole queue: what the plugin asks for while it is answered waits for the next time. */
static Bytes queue_take(Bytes* queue) {
  const Bytes taken = *queue;
  *queue = (Bytes){0};
  return taken;
}

static LV2_Worker_Status
on_respond(LV2_Worker_Respond_Handle handle, uint32_t size, const void* data) {
  HostWorker* const worker = (HostWorker*)handle;
  if (queue_push(&worker->responses, size, data)) {
    return LV2_WORKER_SUCCESS;
  }
  ++worker->n_failed;
  return LV2_WORKER_ERR_NO_SPACE;
}

static void do_work(HostWorker* worker, uint32_t size, const void* data) {
  ++worker->n_works;
  if (worker->interface->work(worker->handle, on_respond, worker, size, data)) {
    ++worker->n_failed;
  }
}

static void deliver(HostWorker* worker, uint32_t size, const void* data) {
  if (worker->interface->work_response) {
    worker->interface->work_response(worker->handle, size, data);
  }
}

static void queue_each(HostWorker* worker,
                       Bytes queue,
                       void (*handle_message)(HostWorker*, uint32_t, const void*)) {
  for (size_t i = 0; i < queue.size;) {
    uint32_t size = 0;
    memcpy(&size, queue.data + i, sizeof(size));
    i += sizeof(size);
    handle_message(worker, size, queue.data + i);
    i += size;
  }
  bytes_clear(&queue);
}

LV2_Worker_Status
host_worker_schedule(LV2_Worker_Schedule_Handle handle, uint32_t size, const void* data) {
  HostWorker* const worker = (HostWorker*)handle;
  if (!worker->interface || worker->mode == HOST_WORK_REFUSED) {
    return LV2_WORKER_ERR_NO_SPACE;
  }
  if (!worker->is_running || worker->mode == HOST_WORK_IN_RUN) {
    do_work(worker, size, data);
    return LV2_WORKER_SUCCESS;
  }
  return queue_push(&worker->requests, size, data) ? LV2_WORKER_SUCCESS : LV2_WORKER_ERR_NO_SPACE;
}

void host_worker_finish_run(HostWorker* worker) {
  if (!worker->interface) {
    return;
  }
  queue_each(worker, queue_take(&worker->requests), do_work);
  queue_each(worker, queue_take(&worker->responses), deliver);
  if (worker->interface->end_run) {
    worker->interface->end_run(worker->handle);
  }
}

void host_worker_clear(HostWorker* worker) {
  bytes_clear(&worker->requests);
  bytes_clear(&worker->responses);
}
