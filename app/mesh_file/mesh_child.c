#include "app/mesh_file/mesh_child.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SECONDS_MOST = 60, GIB_MOST = 8 };

/* A sanitizer's shadow is larger than any memory. */
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define SANITIZED 1
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED 1
#endif
#endif

/* What comes first through the pipe; then vertices, then triangles. */
typedef struct Head {
    bool ok;
    size_t vertex_count, triangle_count;
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

static bool get(int from, void *bytes, size_t size)
{
    for (char *at = bytes; size > 0;) {
        const ssize_t done = read(from, at, size);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return false;
        at += done;
        size -= (size_t)done;
    }
    return true;
}

/* Signals that the parent takes care of would be left undone here. */
static void confine(void)
{
    static const int fatal[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGXCPU, SIGTERM, SIGINT, SIGPIPE};
    const struct rlimit seconds = {SECONDS_MOST, SECONDS_MOST + 1}, no_core = {0, 0};
    for (size_t i = 0; i < sizeof fatal / sizeof *fatal; i++)
        signal(fatal[i], SIG_DFL);
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_CORE, &no_core);
#ifndef SANITIZED
    const struct rlimit memory = {(rlim_t)GIB_MOST << 30, (rlim_t)GIB_MOST << 30};
    setrlimit(RLIMIT_DATA, &memory);
#endif
}

static void be_child(MeshRead *read, const char *path, int to)
{
    Triangles triangles = {0};
    Head head = {.ok = false};
    confine();
    head.ok = read(path, &triangles, &head.error);
    head.vertex_count = triangles.vertex_count;
    head.triangle_count = triangles.triangle_count;
    _exit(
        put(to, &head, sizeof head) &&
                (!head.ok || (put(to, triangles.vertex, head.vertex_count * sizeof *triangles.vertex) &&
                              put(to, triangles.triangle, head.triangle_count * sizeof *triangles.triangle)))
            ? 0
            : 1);
}

static bool take(int from, Triangles *triangles, Error *error)
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
    return (get(from, triangles->vertex, head.vertex_count * sizeof *triangles->vertex) &&
            get(from, triangles->triangle, head.triangle_count * sizeof *triangles->triangle)) ||
           error_set(error, "the process that reads it ended early");
}

/* What its end says, where a signal was it. */
static bool ended_well(pid_t child, bool taken, Error *error)
{
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    if (taken || !WIFSIGNALED(status))
        return taken;
    if (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)
        return error_set(error,
                         "reading it took more than %d s or %d GiB and was stopped; simplify the mesh in a "
                         "modeller",
                         SECONDS_MOST, GIB_MOST);
    return error_set(error, "the library that reads it crashed over it (%s); write it anew with a modeller",
                     strsignal(WTERMSIG(status)));
}

bool mesh_child_read(MeshRead *read, const char *path, Triangles *triangles, Error *error)
{
    int ends[2];
    *triangles = (Triangles){0};
    if (pipe(ends) != 0)
        return error_set(error, "no pipe to the process that reads it: %s", strerror(errno));
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        be_child(read, path, ends[1]);
    }
    close(ends[1]);
    bool ok = child > 0 && take(ends[0], triangles, error);
    close(ends[0]);
    if (child > 0)
        ok = ended_well(child, ok, error);
    else
        error_set(error, "no process to read it: %s", strerror(errno));
    if (!ok)
        triangles_free(triangles);
    return ok;
}
