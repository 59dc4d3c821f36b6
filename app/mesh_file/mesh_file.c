#include "app/mesh_file/mesh_file.h"

#include "app/base/read_file.h"
#include "app/mesh_file/mesh_child.h"
#include "app/mesh_file/mesh_count.h"
#include "app/mesh_file/mesh_move.h"
#include "app/mesh_file/mesh_scene.h"
#include "sim/base/hash.h"
#include "sim/base/parallel.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { HEAD_SIZE = 1 << 16, SECONDS_MOST = 30 };

static const double FAR = 8; /* relative to the mesh's length: costs three bits of a float */

/* ---- before reading ---- */

/* Checks the file's size, and the number of triangles by the first bytes. */
static bool head_fits(const char *path, MeshFormat format, Error *error)
{
    static char head[HEAD_SIZE];
    struct stat about;
    const bool there = stat(path, &about) == 0;
    if (there && !S_ISREG(about.st_mode)) /* opening a pipe would block */
        return error_set(error, "it is no file; name a file that has a mesh");
    FILE *file = there ? fopen(path, "rb") : NULL;
    if (!file)
        return error_set(error, "%s; name a file that is there", strerror(errno));
    const size_t size = fread(head, 1, sizeof head, file);
    fclose(file);
    const double count = mesh_count(format, head, size, (size_t)about.st_size);
    if (count > TRIANGLES_MAX)
        return mesh_too_many(count, error);
    return about.st_size <= (off_t)MESH_FILE_MIB_MAX << 20 ||
           error_set(error, "%.0f MiB, more than the %d that there may be; simplify the mesh in a modeller",
                     (double)about.st_size / (1 << 20), MESH_FILE_MIB_MAX);
}

/* ---- reading ---- */

typedef struct Reading {
    const char *path;
    MeshFormat format;
    size_t mark; /* size of a UTF-8 byte order mark before the text; assimp fails on the mark */
    const struct aiScene *scene;
    MeshBounds bounds;
} Reading;

/* Reads the bytes after the mark; the caller frees the bytes. */
static char *bytes_of(const Reading *reading, size_t *size, Error *error)
{
    char *bytes = read_file(reading->path, (size_t)MESH_FILE_MIB_MAX << 20, "mesh", size, error);
    if (!bytes)
        return NULL;
    *size -= reading->mark;
    memmove(bytes, bytes + reading->mark, *size);
    return bytes;
}

/* Finds a byte order mark. A mark in glTF is refused: glTF forbids marks, and assimp must read glTF by the
   path, to find further files beside the path. */
static bool see_mark(Reading *reading, Error *error)
{
    char begin[84] = "";
    struct stat about = {.st_size = 0};
    FILE *file = fopen(reading->path, "rb");
    const size_t size = file && fstat(fileno(file), &about) == 0 ? fread(begin, 1, sizeof begin, file) : 0;
    if (file)
        fclose(file);
    if (size < 3 || reading->format == MESH_GLB || mesh_is_binary_stl(begin, size, (size_t)about.st_size))
        return true;
    if (memcmp(begin, "\xFF\xFE", 2) == 0 || memcmp(begin, "\xFE\xFF", 2) == 0)
        return error_set(error, "it is a text in UTF-16; write it in UTF-8");
    reading->mark = memcmp(begin, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    return reading->mark == 0 || reading->format != MESH_GLTF ||
           error_set(error, "it begins with a byte order mark, which glTF forbids; write it without one");
}

/* Imports by assimp: from `bytes`; if NULL, from the file, which may name further files. */
static bool import(Reading *reading, const char *bytes, size_t size, Error *error)
{
    const unsigned flags = aiProcess_Triangulate;
    if (reading->scene)
        aiReleaseImport(reading->scene);
    reading->scene =
        bytes ? aiImportFileFromMemory(bytes, (unsigned)size, flags, strrchr(reading->path, '.') + 1)
              : aiImportFile(reading->path, flags);
    if (!reading->scene)
        return error_set(error, "it cannot be read: %.300s; write it anew with a modeller",
                         aiGetErrorString());
    mesh_scene_bounds(reading->scene, &reading->bounds);
    return true;
}

static double longest_side(const MeshBounds *bounds)
{
    double longest = 0;
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, bounds->high[k] - bounds->low[k]);
    return longest;
}

/* True if floats lose some bits of the mesh's positions. */
static bool is_far(const MeshBounds *bounds)
{
    double largest = 0;
    for (int k = 0; k < 3; k++)
        largest = fmax(largest, fmax(fabs(bounds->low[k]), fabs(bounds->high[k])));
    return isfinite(largest) && largest > FAR * longest_side(bounds);
}

/* Reads text and doubles again, moved to 0, where floats lose no bits. */
static bool read_moved(Reading *reading, Error *error)
{
    size_t size, moved_size;
    double middle[3];
    char *bytes = bytes_of(reading, &size, error);
    if (!bytes)
        return false;
    for (int k = 0; k < 3; k++)
        middle[k] = 0.5 * (reading->bounds.low[k] + reading->bounds.high[k]);
    char *moved = mesh_moved(reading->format, bytes, size, middle, &moved_size);
    free(bytes);
    const bool ok = !moved || import(reading, moved, moved_size, error);
    free(moved);
    return ok;
}

static bool read_first(Reading *reading, Error *error)
{
    size_t size = 0;
    char *bytes = NULL;
    if (reading->mark > 0 && !(bytes = bytes_of(reading, &size, error)))
        return false;
    const bool ok = import(reading, bytes, size, error);
    free(bytes);
    return ok;
}

/* Takes the triangles of the scene; moves a mesh far from 0 to 0. */
static bool take(const Reading *reading, Triangles *triangles, Error *error)
{
    const MeshBounds *bounds = &reading->bounds;
    double origin[3] = {0};
    const bool far = is_far(bounds);
    for (int k = 0; k < 3 && far; k++)
        origin[k] = 0.5 * (bounds->low[k] + bounds->high[k]);
    triangles->largest = far ? bounds->largest : 0;
    return mesh_scene_take(reading->scene, origin, triangles, error);
}

bool mesh_file_read(const char *path, Triangles *triangles, Error *error)
{
    *triangles = (Triangles){0};
    if (mesh_format(path) == MESH_UNKNOWN)
        return error_set(
            error, "its ending is of no format that is read; name a file .obj, .ply, .stl, .gltf or .glb");
    if (!head_fits(path, mesh_format(path), error))
        return false;
    Reading reading = {.path = path, .format = mesh_format(path)};
    const bool ok = see_mark(&reading, error) && read_first(&reading, error) &&
                    (!is_far(&reading.bounds) || read_moved(&reading, error)) &&
                    take(&reading, triangles, error);
    if (reading.scene)
        aiReleaseImport(reading.scene);
    if (!ok)
        triangles_free(triangles);
    return ok;
}

/* ---- kept meshes ---- */

typedef struct Kept {
    struct Kept *next;
    uint64_t hash; /* of the file's bytes */
    size_t size;
    MeshShape *shape;
    MeshState state;
} Kept;

static pthread_mutex_t keeping = PTHREAD_MUTEX_INITIALIZER; /* a waiting window may load further meshes */
static Kept *all_kept;

static const Kept *find_kept(uint64_t of, size_t size)
{
    pthread_mutex_lock(&keeping);
    const Kept *kept = all_kept;
    while (kept && (kept->hash != of || kept->size != size))
        kept = kept->next;
    pthread_mutex_unlock(&keeping);
    return kept;
}

/* Makes and keeps a shape; takes ownership of the triangles. Returns NULL with the error set. */
static const Kept *keep(Triangles *triangles, uint64_t of, size_t size, Error *error)
{
    Kept *kept = calloc(1, sizeof *kept);
    if (kept)
        kept->shape = mesh_shape_make(triangles, parallel_processors(), &kept->state, error);
    else
        error_set(error, "no memory for its %zu triangles", triangles->triangle_count);
    triangles_free(triangles);
    if (!kept || !kept->shape) {
        free(kept);
        return NULL;
    }
    kept->hash = of, kept->size = size;
    pthread_mutex_lock(&keeping);
    kept->next = all_kept;
    all_kept = kept;
    pthread_mutex_unlock(&keeping);
    return kept;
}

/* Counts the triangles of a text before assimp takes many times the text's size; hashes the bytes. */
static bool bytes_fit(const char *path, MeshFormat format, uint64_t *of, size_t *size, Error *error)
{
    char *bytes = read_file(path, (size_t)MESH_FILE_MIB_MAX << 20, "mesh", size, error);
    if (!bytes)
        return false;
    const double count = mesh_count(format, bytes, *size, *size);
    const bool whole = mesh_has_head(format, bytes, *size);
    *of = hash_add(HASH_NONE, bytes, *size);
    free(bytes);
    if (!whole)
        return error_set(error,
                         "it has no line end_header and was cut, or is still being written; write it anew");
    return count <= TRIANGLES_MAX || mesh_too_many(count, error);
}

/* A file to read, with the hash and size of the bytes. */
typedef struct Job {
    char path[4096];
    MeshFormat format;
    uint64_t of;
    size_t size;
    const Kept *kept; /* result; NULL: see error */
    Error error;
    atomic_bool done;
} Job;

/* Reads a file. A text glTF names further files, so triangles identify the mesh instead of the file's
   bytes. */
static const Kept *read_one(const Job *job, Error *error)
{
    Triangles triangles;
    uint64_t of = job->of;
    size_t size = job->size;
    const Kept *kept = NULL;
    if (!mesh_child_read(mesh_file_read, job->path, SECONDS_MOST, &triangles, error))
        return NULL;
    if (job->format == MESH_GLTF) {
        of = hash_add(HASH_NONE, triangles.vertex, triangles.vertex_count * sizeof *triangles.vertex);
        of = hash_add(of, triangles.triangle, triangles.triangle_count * sizeof *triangles.triangle);
        of = hash_add(of, &triangles.largest, sizeof triangles.largest);
        size = triangles.triangle_count;
        kept = find_kept(of, size);
    }
    if (!kept)
        return keep(&triangles, of, size, error);
    triangles_free(&triangles);
    return kept;
}

static void *do_job(void *argument)
{
    Job *job = argument;
    job->kept = read_one(job, &job->error);
    atomic_store(&job->done, true);
    return NULL;
}

/* ---- work of a window meanwhile ---- */

static struct {
    void (*call)(void *user); /* NULL: no calls */
    void *user;
    pthread_t thread; /* thread of the window */
    bool waits;       /* true while a wait calls `call` */
} meanwhile;

void mesh_file_meanwhile(void (*call)(void *user), void *user)
{
    meanwhile.call = call;
    meanwhile.user = user;
    meanwhile.thread = pthread_self();
}

/* Starts a thread with all signals blocked: signals are for the thread of the window. */
static bool start_thread(Job *job, pthread_t *thread)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(thread, NULL, do_job, job) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

static void do_beside(Job *job)
{
    pthread_t thread;
    const bool waits = meanwhile.call && !meanwhile.waits && pthread_equal(pthread_self(), meanwhile.thread);
    if (!waits || !start_thread(job, &thread)) {
        do_job(job);
        return;
    }
    meanwhile.waits = true;
    while (!atomic_load(&job->done))
        meanwhile.call(meanwhile.user);
    meanwhile.waits = false;
    pthread_join(thread, NULL);
}

static const Kept *look_up(const char *path, MeshFormat format, Error *error)
{
    uint64_t of;
    size_t size;
    if (!bytes_fit(path, format, &of, &size, error))
        return NULL;
    const Kept *kept = format == MESH_GLTF ? NULL : find_kept(of, size);
    Job *job = kept ? NULL : calloc(1, sizeof *job); /* a window may leave the job to the thread by longjmp */
    if (!job) {
        if (!kept)
            error_set(error, "no memory to read it");
        return kept;
    }
    *job = (Job){.format = format, .of = of, .size = size};
    snprintf(job->path, sizeof job->path, "%s", path);
    do_beside(job);
    kept = job->kept;
    if (!kept)
        *error = job->error;
    free(job);
    return kept;
}

const MeshShape *mesh_file_load(const char *path, MeshState *state, Error *error)
{
    const MeshFormat format = mesh_format(path);
    const Kept *kept = NULL;
    if (format == MESH_UNKNOWN)
        error_set(error,
                  "its ending is of no format that is read; name a file .obj, .ply, .stl, .gltf or .glb");
    else if (head_fits(path, format, error))
        kept = look_up(path, format, error);
    if (!kept)
        return NULL;
    *state = kept->state;
    return kept->shape;
}
