#include "app/mesh_file/mesh_file.h"

#include "app/base/read_file.h"
#include "app/mesh_file/mesh_child.h"
#include "app/mesh_file/mesh_count.h"
#include "sim/base/hash.h"
#include "sim/base/parallel.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { HEAD_SIZE = 1 << 16, SECONDS_MOST = 30 };

/* ---- before it is read ---- */

static bool too_many(double count, Error *error)
{
    char has[32], most[32];
    number_grouped((size_t)count, has);
    number_grouped(TRIANGLES_MAX, most);
    return error_set(error,
                     "%s triangles, more than the %s that there may be; simplify the mesh in a modeller", has,
                     most);
}

/* What a few bytes of it and its size say. */
static bool head_fits(const char *path, MeshFormat format, Error *error)
{
    static char head[HEAD_SIZE];
    struct stat about;
    const bool there = stat(path, &about) == 0;
    if (there && !S_ISREG(about.st_mode)) /* a pipe would be waited for */
        return error_set(error, "it is no file; name a file that has a mesh");
    FILE *file = there ? fopen(path, "rb") : NULL;
    if (!file)
        return error_set(error, "%s; name a file that is there", strerror(errno));
    const size_t size = fread(head, 1, sizeof head, file);
    fclose(file);
    const double count = mesh_count(format, head, size, (size_t)about.st_size);
    if (count > TRIANGLES_MAX)
        return too_many(count, error);
    return about.st_size <= (off_t)MESH_FILE_MIB_MAX << 20 ||
           error_set(error, "%.0f MiB, more than the %d that there may be; simplify the mesh in a modeller",
                     (double)about.st_size / (1 << 20), MESH_FILE_MIB_MAX);
}

/* ---- reading it ---- */

/* Of the points and lines among its faces nothing is taken, nor of what names vertices that are not there. */
static bool is_triangle(const struct aiMesh *mesh, unsigned f)
{
    const struct aiFace *face = &mesh->mFaces[f];
    bool is = face->mNumIndices == 3;
    for (int c = 0; c < 3 && is; c++)
        is = face->mIndices[c] < mesh->mNumVertices;
    return is;
}

static size_t triangles_of(const struct aiMesh *mesh)
{
    size_t count = 0;
    for (unsigned f = 0; f < mesh->mNumFaces; f++)
        count += is_triangle(mesh, f);
    return count;
}

static bool allocate(const struct aiScene *scene, Triangles *triangles, Error *error)
{
    size_t vertices = 0, count = 0;
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        vertices += scene->mMeshes[m]->mNumVertices;
        count += triangles_of(scene->mMeshes[m]);
    }
    if (count > TRIANGLES_MAX)
        return too_many((double)count, error);
    if (count == 0)
        return error_set(error, "it has no triangles; a solid is a closed surface of them");
    triangles->vertex = malloc((vertices + 1) * sizeof *triangles->vertex);
    triangles->triangle = malloc((count + 1) * sizeof *triangles->triangle);
    if (triangles->vertex && triangles->triangle)
        return true;
    error_set(error, "no memory for its %zu triangles", count);
    return false;
}

static void take(const struct aiMesh *mesh, Triangles *triangles)
{
    const uint32_t first = (uint32_t)triangles->vertex_count;
    for (unsigned f = 0; f < mesh->mNumFaces; f++)
        if (is_triangle(mesh, f)) {
            uint32_t *corner = triangles->triangle[triangles->triangle_count++];
            for (int c = 0; c < 3; c++)
                corner[c] = first + mesh->mFaces[f].mIndices[c];
        }
    for (unsigned v = 0; v < mesh->mNumVertices; v++) {
        const struct aiVector3D *from = &mesh->mVertices[v];
        float *to = triangles->vertex[triangles->vertex_count++];
        to[0] = from->x, to[1] = from->y, to[2] = from->z;
    }
}

bool mesh_file_read(const char *path, Triangles *triangles, Error *error)
{
    *triangles = (Triangles){0};
    if (mesh_format(path) == MESH_UNKNOWN)
        return error_set(
            error, "its ending is of no format that is read; name a file .obj, .ply, .stl, .gltf or .glb");
    if (!head_fits(path, mesh_format(path), error))
        return false;
    const struct aiScene *scene = aiImportFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices);
    if (!scene)
        return error_set(error, "it cannot be read: %.300s; write it anew with a modeller",
                         aiGetErrorString());
    const bool ok = allocate(scene, triangles, error);
    for (unsigned m = 0; ok && triangles->vertex && m < scene->mNumMeshes; m++)
        take(scene->mMeshes[m], triangles);
    aiReleaseImport(scene);
    if (!ok)
        triangles_free(triangles);
    return ok;
}

/* ---- those that were read ---- */

typedef struct Kept {
    struct Kept *next;
    uint64_t hash; /* of the file's bytes */
    size_t size;
    MeshShape *shape;
    MeshState state;
} Kept;

static pthread_mutex_t keeping = PTHREAD_MUTEX_INITIALIZER; /* a window that waits for one may draw another */
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

/* Takes the triangles over. */
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

/* A text of lines is counted before assimp takes many times its size. */
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
    return count <= TRIANGLES_MAX || too_many(count, error);
}

/* A file that is to be read, of so many bytes with that hash. */
typedef struct Job {
    char path[4096];
    MeshFormat format;
    uint64_t of;
    size_t size;
    const Kept *kept; /* what came of it; NULL: the error */
    Error error;
    atomic_bool done;
} Job;

/* A glTF in text names further files: it is known by what it makes. */
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

/* ---- what a window does meanwhile ---- */

static struct {
    void (*call)(void *user); /* NULL: nothing */
    void *user;
    pthread_t thread; /* its own */
    bool waits;       /* it is being called */
} meanwhile;

void mesh_file_meanwhile(void (*call)(void *user), void *user)
{
    meanwhile.call = call;
    meanwhile.user = user;
    meanwhile.thread = pthread_self();
}

/* Signals are for the thread of the window. */
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
    Job *job = kept ? NULL : calloc(1, sizeof *job); /* a window may leave it to its thread by longjmp */
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
