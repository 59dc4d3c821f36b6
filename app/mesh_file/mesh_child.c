#define _GNU_SOURCE /* pipe2 */
#include "app/mesh_file/mesh_child.h"

#include "app/base/interrupt.h"
#include "sim/base/stage.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { GIB_MOST = 8, LOOK_MS = 20 };

/* The shadow memory of a sanitizer is larger than any limit. */
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define SANITIZED 1
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED 1
#endif
#endif

/* First record in the pipe; then vertices, then triangles. */
typedef struct Head {
    bool ok;
    size_t vertex_count, triangle_count;
    double largest;
    Error error;
} Head;

static bool put(int to, const void *bytes, size_t size)
{
    for (const char *at = bytes; size > 0;) {
        const ssize_t done = write(to, at, size);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return false;
        at += done;
        size -= (size_t)done;
    }
    return true;
}

/* The parent's wait for the child. */
typedef struct Wait {
    int from;
    double until_ms; /* wall time */
    bool late;
} Wait;

/* Waits until bytes can be read, or the pipe's end. Returns false if late or interrupted. */
static bool comes(Wait *wait)
{
    struct pollfd look = {.fd = wait->from, .events = POLLIN};
    int ready = 0;
    while (ready <= 0 && !wait->late && !interrupted()) {
        ready = poll(&look, 1, LOOK_MS);
        wait->late = ready <= 0 && wall_ms() > wait->until_ms;
    }
    return ready > 0;
}

static bool get(Wait *wait, void *bytes, size_t size)
{
    for (char *at = bytes; size > 0;) {
        const ssize_t done = comes(wait) ? read(wait->from, at, size) : 0;
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return false;
        at += done;
        size -= (size_t)done;
    }
    return true;
}

/* Limits the child's processor time and memory. Restores default signal actions: handlers of the parent do
   not serve the child. */
static void confine(double seconds)
{
    static const int fatal[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGXCPU, SIGTERM, SIGINT, SIGPIPE};
    const rlim_t most = (rlim_t)ceil(seconds);
    const struct rlimit processor = {most, most + 1}, no_core = {0, 0};
    for (size_t i = 0; i < sizeof fatal / sizeof *fatal; i++)
        signal(fatal[i], SIG_DFL);
    setrlimit(RLIMIT_CPU, &processor);
    setrlimit(RLIMIT_CORE, &no_core);
#ifndef SANITIZED
    const struct rlimit memory = {(rlim_t)GIB_MOST << 30, (rlim_t)GIB_MOST << 30};
    setrlimit(RLIMIT_DATA, &memory);
#endif
}

static void be_child(MeshRead *read, const char *path, double seconds, int to)
{
    Triangles triangles = {0};
    Head head = {.ok = false};
    confine(seconds);
    head.ok = read(path, &triangles, &head.error);
    head.vertex_count = triangles.vertex_count;
    head.triangle_count = triangles.triangle_count;
    head.largest = triangles.largest;
    _exit(
        put(to, &head, sizeof head) &&
                (!head.ok || (put(to, triangles.vertex, head.vertex_count * sizeof *triangles.vertex) &&
                              put(to, triangles.triangle, head.triangle_count * sizeof *triangles.triangle)))
            ? 0
            : 1);
}

static bool take(Wait *from, Triangles *triangles, Error *error)
{
    Head head;
    if (!get(from, &head, sizeof head))
        return error_set(error, "the process that reads it ended early");
    if (!head.ok) {
        *error = head.error;
        return false;
    }
    triangles->vertex = malloc((head.vertex_count + 1) * sizeof *triangles->vertex);
    triangles->triangle = malloc((head.triangle_count + 1) * sizeof *triangles->triangle);
    if (!triangles->vertex || !triangles->triangle)
        return error_set(error, "no memory for its %zu triangles", head.triangle_count);
    triangles->vertex_count = head.vertex_count;
    triangles->triangle_count = head.triangle_count;
    triangles->largest = head.largest;
    return (get(from, triangles->vertex, head.vertex_count * sizeof *triangles->vertex) &&
            get(from, triangles->triangle, head.triangle_count * sizeof *triangles->triangle)) ||
           error_set(error, "the process that reads it ended early");
}

/* Waits for the child; kills the child first if late or interrupted. Returns `taken`; sets the error if a
   signal ended the child. */
static bool ended_well(pid_t child, const Wait *wait, double seconds, bool taken, Error *error)
{
    int status = 0;
    const bool stopped = interrupted();
    if (!taken && (wait->late || stopped))
        kill(child, SIGKILL);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    if (taken || !WIFSIGNALED(status) || WTERMSIG(status) == SIGPIPE)
        return taken;
    if (stopped)
        return error_set(error, "stopped");
    if (wait->late || WTERMSIG(status) == SIGXCPU)
        return error_set(error,
                         "reading it took more than %g s and was stopped; simplify the mesh in a modeller",
                         seconds);
    if (WTERMSIG(status) == SIGKILL)
        return error_set(error,
                         "reading it was stopped, for want of memory maybe; simplify the mesh in a modeller");
    return error_set(error, "the library that reads it crashed over it (%s); write it anew with a modeller",
                     strsignal(WTERMSIG(status)));
}

bool mesh_child_read(MeshRead *read, const char *path, double seconds, Triangles *triangles, Error *error)
{
    int ends[2];
    *triangles = (Triangles){0};
    if (pipe2(ends, O_CLOEXEC) != 0)
        return error_set(error, "no pipe to the process that reads it: %s", strerror(errno));
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        be_child(read, path, seconds, ends[1]);
    }
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return error_set(error, "no process to read it: %s", strerror(errno));
    }
    Wait wait = {.from = ends[0], .until_ms = wall_ms() + 1000 * seconds};
    const bool taken = take(&wait, triangles, error);
    close(ends[0]);
    const bool ok = ended_well(child, &wait, seconds, taken, error);
    if (!ok)
        triangles_free(triangles);
    return ok;
}
