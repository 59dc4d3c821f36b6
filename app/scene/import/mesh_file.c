#define _GNU_SOURCE /* pipe2 */
#include "app/scene/import/import.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/scene/import/import_private.h"
#include "sim/base/base.h"
#include "sim/world.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Transform from a mesh to the scene: rows of a matrix, the offset in the last column. */
typedef struct NodePlacement {
    double row[3][4];
} NodePlacement;

typedef void VisitMesh(void *context, const struct aiMesh *mesh, const NodePlacement *way);

/* "12,000,000 triangles, more than the ..." */
static bool mesh_too_many(double count, Error *error)
{
    char has[32], most[32];
    number_grouped((size_t)count, has);
    number_grouped(TRIANGLES_MAX, most);
    return error_set(error,
                     "%s triangles, more than the %s that there may be; simplify the mesh in a modeller", has,
                     most);
}

/* ---- nodes ---- */

static NodePlacement way_of(const NodePlacement *parent, const struct aiMatrix4x4 *m)
{
    const double own[4][4] = {{m->a1, m->a2, m->a3, m->a4},
                              {m->b1, m->b2, m->b3, m->b4},
                              {m->c1, m->c2, m->c3, m->c4},
                              {0, 0, 0, 1}};
    NodePlacement way;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            way.row[i][j] = 0;
            for (int k = 0; k < 4; k++)
                way.row[i][j] += parent->row[i][k] * own[k][j];
        }
    return way;
}

static void visit(const struct aiScene *scene, const struct aiNode *node, const NodePlacement *parent,
                  VisitMesh *with, void *context)
{
    const NodePlacement way = way_of(parent, &node->mTransformation);
    for (unsigned m = 0; m < node->mNumMeshes; m++)
        with(context, scene->mMeshes[node->mMeshes[m]], &way);
    for (unsigned c = 0; c < node->mNumChildren; c++)
        visit(scene, node->mChildren[c], &way, with, context);
}

static void visit_all(const struct aiScene *scene, VisitMesh *with, void *context)
{
    static const NodePlacement none = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    if (scene->mRootNode)
        visit(scene, scene->mRootNode, &none, with, context);
}

static void place(const NodePlacement *way, const struct aiVector3D *x, double at[3])
{
    for (int k = 0; k < 3; k++)
        at[k] = way->row[k][0] * x->x + way->row[k][1] * x->y + way->row[k][2] * x->z + way->row[k][3];
}

static bool mirrors(const NodePlacement *way)
{
    const double(*m)[4] = way->row;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
           0;
}

/* ---- triangles ---- */

/* True if a face is a triangle of existing vertices. Points, lines and faces with bad indices are skipped. */
static bool is_triangle(const struct aiMesh *mesh, unsigned f)
{
    const struct aiFace *face = &mesh->mFaces[f];
    bool is = face->mNumIndices == 3;
    for (int c = 0; c < 3 && is; c++)
        is = face->mIndices[c] < mesh->mNumVertices;
    return is;
}

typedef struct Counts {
    double vertices, triangles, meshes;
} Counts;

static void count_mesh(void *context, const struct aiMesh *mesh, const NodePlacement *way)
{
    Counts *counts = context;
    (void)way;
    counts->meshes++;
    counts->vertices += mesh->mNumVertices;
    for (unsigned f = 0; f < mesh->mNumFaces; f++)
        counts->triangles += is_triangle(mesh, f);
}

typedef struct Bounded {
    MeshBounds *bounds;
    bool alone;
} Bounded;

/* The offset of the only mesh of a scene does not count. */
static void bound_mesh(void *context, const struct aiMesh *mesh, const NodePlacement *way)
{
    const Bounded *bounded = context;
    MeshBounds *bounds = bounded->bounds;
    for (unsigned v = 0; v < mesh->mNumVertices; v++) {
        double at[3];
        place(way, &mesh->mVertices[v], at);
        for (int k = 0; k < 3; k++) {
            const double by = way->row[k][3], own = fabs(at[k] - by);
            bounds->low[k] = fmin(bounds->low[k], at[k]);
            bounds->high[k] = fmax(bounds->high[k], at[k]);
            bounds->largest = fmax(bounds->largest, bounded->alone ? own : fmax(own, fabs(by)));
        }
    }
}

static void mesh_scene_bounds(const struct aiScene *scene, MeshBounds *bounds)
{
    Counts counts = {0};
    *bounds = (MeshBounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
    visit_all(scene, count_mesh, &counts);
    Bounded bounded = {bounds, counts.meshes < 2};
    visit_all(scene, bound_mesh, &bounded);
}

typedef struct TakenMesh {
    Triangles *triangles;
    double origin[3];
} TakenMesh;

static void take_mesh(void *context, const struct aiMesh *mesh, const NodePlacement *way)
{
    const TakenMesh *taken = context;
    Triangles *triangles = taken->triangles;
    const uint32_t first = (uint32_t)triangles->vertex_count;
    const bool mirrored = mirrors(way);
    for (unsigned f = 0; f < mesh->mNumFaces; f++)
        if (is_triangle(mesh, f)) {
            uint32_t *corner = triangles->triangle[triangles->triangle_count++];
            for (int c = 0; c < 3; c++)
                corner[c] = first + mesh->mFaces[f].mIndices[c];
            if (mirrored)
                triangle_turn(triangles, triangles->triangle_count - 1);
        }
    for (unsigned v = 0; v < mesh->mNumVertices; v++) {
        double at[3];
        float *to = triangles->vertex[triangles->vertex_count++];
        place(way, &mesh->mVertices[v], at);
        for (int k = 0; k < 3; k++)
            to[k] = (float)(at[k] - taken->origin[k]);
    }
}

/* Takes the triangles of all meshes, placed by the nodes, less `origin`; turns triangles of mirroring nodes,
   as glTF asks. The caller frees with triangles_free, also after false. Returns false if there are no
   triangles or more than TRIANGLES_MAX, or memory is short. */
static bool mesh_scene_take(const struct aiScene *scene, const double origin[3], Triangles *triangles,
                            Error *error)
{
    Counts counts = {0};
    TakenMesh taken = {triangles, {origin[0], origin[1], origin[2]}};
    visit_all(scene, count_mesh, &counts);
    if (counts.triangles > TRIANGLES_MAX)
        return mesh_too_many(counts.triangles, error);
    if (counts.triangles == 0)
        return error_set(error, "it has no triangles; a solid is a closed surface of them");
    triangles->vertex = malloc((size_t)(counts.vertices + 1) * sizeof *triangles->vertex);
    triangles->triangle = malloc((size_t)(counts.triangles + 1) * sizeof *triangles->triangle);
    if (!triangles->vertex || !triangles->triangle)
        return error_set(error, "no memory for its %.0f triangles", counts.triangles);
    visit_all(scene, take_mesh, &taken);
    return true;
}

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
typedef struct PipeHead {
    bool ok;
    size_t vertex_count, triangle_count;
    double largest;
    Error error;
} PipeHead;

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
typedef struct PipeWait {
    int from;
    double until_ms; /* wall time */
    bool late;
} PipeWait;

/* Waits until bytes can be read, or the pipe's end. Returns false if late or interrupted. */
static bool comes(PipeWait *wait)
{
    struct pollfd look = {.fd = wait->from, .events = POLLIN};
    int ready = 0;
    while (ready <= 0 && !wait->late && !interrupted()) {
        ready = poll(&look, 1, LOOK_MS);
        wait->late = ready <= 0 && wall_ms() > wait->until_ms;
    }
    return ready > 0;
}

static bool get(PipeWait *wait, void *bytes, size_t size)
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
    PipeHead head = {.ok = false};
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

static bool take_output(PipeWait *from, Triangles *triangles, Error *error)
{
    PipeHead head;
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
static bool ended_well(pid_t child, const PipeWait *wait, double seconds, bool taken, Error *error)
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
    PipeWait wait = {.from = ends[0], .until_ms = wall_ms() + 1000 * seconds};
    const bool taken = take_output(&wait, triangles, error);
    close(ends[0]);
    const bool ok = ended_well(child, &wait, seconds, taken, error);
    if (!ok)
        triangles_free(triangles);
    return ok;
}

/* Seconds for the process that reads, and for the solid made of the triangles: a hundred times what 100,000
   triangles take. */
enum { HEAD_SIZE = 1 << 16, SECONDS_MOST = 30, MAKING_MOST = 300 };

static const double FAR = 8; /* relative to the mesh's length: costs three bits of a float */

/* ---- before reading ---- */

/* Checks the file's size, and the number of triangles by the first bytes. */
static bool head_fits(const char *path, MeshFormat format, Error *error)
{
    char head[HEAD_SIZE];
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

typedef struct MeshReading {
    const char *path;
    MeshFormat format;
    size_t mark; /* size of a UTF-8 byte order mark before the text; assimp fails on the mark */
    const struct aiScene *scene;
    MeshBounds bounds;
} MeshReading;

/* Reads the bytes after the mark; the caller frees the bytes. */
static char *bytes_of(const MeshReading *reading, size_t *size, Error *error)
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
static bool see_mark(MeshReading *reading, Error *error)
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
static bool import(MeshReading *reading, const char *bytes, size_t size, Error *error)
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
static bool read_moved(MeshReading *reading, Error *error)
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

static bool read_first(MeshReading *reading, Error *error)
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
static bool take(const MeshReading *reading, Triangles *triangles, Error *error)
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
    MeshReading reading = {.path = path, .format = mesh_format(path)};
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

typedef struct CachedMesh {
    struct CachedMesh *next;
    uint64_t hash; /* of the file's bytes */
    size_t size;
    MeshShape *shape;
    MeshState state;
} CachedMesh;

static pthread_mutex_t keeping = PTHREAD_MUTEX_INITIALIZER; /* a waiting window may load further meshes */
static CachedMesh *all_kept;

static const CachedMesh *find_kept(uint64_t of, size_t size)
{
    pthread_mutex_lock(&keeping);
    const CachedMesh *kept = all_kept;
    while (kept && (kept->hash != of || kept->size != size))
        kept = kept->next;
    pthread_mutex_unlock(&keeping);
    return kept;
}

static bool takes_too_long(void *until_ms)
{
    return interrupted() || wall_ms() > *(const double *)until_ms;
}

/* Makes a shape; takes ownership of the triangles. Returns NULL with the error set. */
static MeshShape *make_shape(Triangles *triangles, MeshState *state, Error *error)
{
    double until_ms = wall_ms() + 1000.0 * MAKING_MOST;
    const Stop stop = {takes_too_long, &until_ms};
    MeshShape *shape = mesh_shape_make(triangles, parallel_processors(), &stop, state, error);
    if (!shape && !interrupted() && wall_ms() > until_ms)
        error_set(error,
                  "making a solid of it took more than %d s and was stopped; simplify the mesh in a modeller",
                  MAKING_MOST);
    return shape;
}

/* Makes and keeps a shape; takes ownership of the triangles. Returns NULL with the error set. */
static const CachedMesh *keep(Triangles *triangles, uint64_t of, size_t size, Error *error)
{
    CachedMesh *kept = calloc(1, sizeof *kept);
    if (kept)
        kept->shape = make_shape(triangles, &kept->state, error);
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
typedef struct MeshJob {
    char path[4096];
    MeshFormat format;
    uint64_t of;
    size_t size;
    const CachedMesh *kept; /* result; NULL: see error */
    Error error;
    atomic_bool done;
} MeshJob;

/* Reads a file. A text glTF names further files, so triangles identify the mesh instead of the file's
   bytes. */
static const CachedMesh *read_one(const MeshJob *job, Error *error)
{
    Triangles triangles;
    uint64_t of = job->of;
    size_t size = job->size;
    const CachedMesh *kept = NULL;
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
    MeshJob *job = argument;
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

void mesh_file_on_wait(void (*call)(void *user), void *user)
{
    meanwhile.call = call;
    meanwhile.user = user;
    meanwhile.thread = pthread_self();
}

/* Starts a thread with all signals blocked: signals are for the thread of the window. */
static bool start_thread(MeshJob *job, pthread_t *thread)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(thread, NULL, do_job, job) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

static void do_beside(MeshJob *job)
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

static const CachedMesh *look_up(const char *path, MeshFormat format, Error *error)
{
    uint64_t of;
    size_t size;
    if (!bytes_fit(path, format, &of, &size, error))
        return NULL;
    const CachedMesh *kept = format == MESH_GLTF ? NULL : find_kept(of, size);
    MeshJob *job =
        kept ? NULL : calloc(1, sizeof *job); /* a window may leave the job to the thread by longjmp */
    if (!job) {
        if (!kept)
            error_set(error, "no memory to read it");
        return kept;
    }
    *job = (MeshJob){.format = format, .of = of, .size = size};
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
    const CachedMesh *kept = NULL;
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
