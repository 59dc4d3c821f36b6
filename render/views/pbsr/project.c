#include "render/views/pbsr/pbsr_private.h"
#include "shaders/pbsr/pbsr_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>

/* Each block needs a buffer, even if the shader reads nothing. */
static const float nothing[4] = {0};

bool projector_create(Projector *project, Error *error)
{
    static const char *const stages[] = {"pbsr/project.comp", NULL};
    static const char *const labels[PIECES_BUFFERS] = {"layer points", "layer corners", "layer shares",
                                                       "points that stay"};
    for (int i = 0; i < PBSR_LAYERS_MAX; i++) {
        glCreateBuffers(PIECES_BUFFERS, project->layers[i].buffers);
        for (int k = 0; k < PIECES_BUFFERS; k++) {
            glObjectLabel(GL_BUFFER, project->layers[i].buffers[k], -1, labels[k]);
            glNamedBufferData(project->layers[i].buffers[k], sizeof nothing, nothing, GL_STREAM_DRAW);
        }
    }
    glCreateBuffers(SOLIDS_MAX, project->solids);
    for (int i = 0; i < SOLIDS_MAX; i++)
        glObjectLabel(GL_BUFFER, project->solids[i], -1, "points of a solid");
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &project->block_bytes);
    project->program = program_create("pbsr project", stages, NULL, error);
    return project->program != 0;
}

void projector_destroy(Projector *project)
{
    for (int i = 0; i < PBSR_LAYERS_MAX; i++)
        glDeleteBuffers(PIECES_BUFFERS, project->layers[i].buffers);
    glDeleteBuffers(SOLIDS_MAX, project->solids);
    glDeleteProgram(project->program);
}

static void send(unsigned buffer, const void *data, size_t bytes)
{
    if (bytes > 0)
        glNamedBufferData(buffer, (GLsizeiptr)bytes, data, GL_STREAM_DRAW);
}

static bool is_there(Error *error)
{
    return gl_errors_take(GL_OUT_OF_MEMORY) == 0 ||
           error_set(error,
                     "the GPU has no memory for the points of a layer; view.pbsr.method: cpu needs none");
}

size_t layer_piece_bytes(const LayerPieces *layer)
{
    return (layer->cells ? 1 : 3) * sizeof(LayerPoint);
}

bool projector_reserve(const Projector *project, int index, const LayerPieces *layer, Error *error)
{
    const unsigned *to = project->layers[index].buffers;
    glNamedBufferData(to[PIECES_POINTS], (GLsizeiptr)(layer->on_gpu * layer_piece_bytes(layer)), NULL,
                      GL_DYNAMIC_COPY);
    glNamedBufferData(to[PIECES_SHARES], (GLsizeiptr)(layer->on_gpu * sizeof(LayerShare)), NULL,
                      GL_DYNAMIC_COPY);
    return is_there(error);
}

/* Offsets in both buffers are multiples of 256 bytes, as bindings need. */
bool projector_next_range(const Projector *project, int index, size_t bytes, size_t pieces, PieceRange *range)
{
    enum { STEP = 32 };
    const unsigned *from = project->layers[index].buffers;
    const size_t share = sizeof(LayerShare), most = (size_t)project->block_bytes / (STEP * bytes) * STEP;
    range->first += range->count;
    range->count = pieces - range->first < most ? pieces - range->first : most;
    if (range->count == 0)
        return false;
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, PIECE_POINTS_STORAGE, from[PIECES_POINTS],
                      (GLintptr)(range->first * bytes), (GLsizeiptr)(range->count * bytes));
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, PIECE_SHARES_STORAGE, from[PIECES_SHARES],
                      (GLintptr)(range->first * share), (GLsizeiptr)(range->count * share));
    glUniform1ui(PIECE_FIRST_AT, (GLuint)range->first);
    glUniform1ui(PIECE_COUNT_AT, (GLuint)range->count);
    return true;
}

static float largest_of(const LayerPieces *layer, size_t shares)
{
    float largest = layer->largest;
    for (size_t i = 0; !layer->on_gpu && i < shares; i++)
        largest = fmaxf(largest, layer->share[i].expected);
    return largest;
}

static void send_pieces(const unsigned *to, const LayerPieces *layer, size_t shares)
{
    send(to[PIECES_POINTS], layer->point, layer->point_count * sizeof *layer->point);
    send(to[PIECES_CORNERS], layer->triangle, layer->triangle_count * sizeof *layer->triangle);
    send(to[PIECES_SHARES], layer->share, shares * sizeof *layer->share);
}

bool projector_upload(Projector *project, int index, const LayerPieces *layer, const RigidLayer *rigid,
                      Error *error)
{
    const size_t corners = layer->triangle_count > 0 ? layer->point_count * sizeof *layer->point : 0;
    const size_t shares = layer->triangle_count > 0 ? layer->triangle_count : layer->point_count;
    const unsigned *to = project->layers[index].buffers;
    if (corners > (size_t)project->block_bytes)
        return error_set(
            error,
            "a layer's corners are %.3g MB, and a shader sees %.3g MB here; view.pbsr.method: cpu, or "
            "a larger view.pbsr.cell",
            (double)corners / 1e6, (double)project->block_bytes / 1e6);
    if (!layer->on_gpu)
        send_pieces(to, layer, shares);
    project->layers[index].largest = largest_of(layer, shares);
    if (project->rigid[index] != rigid->made && !rigid->buffer)
        send(to[PIECES_STILL], rigid->points.point, rigid->points.count * sizeof *rigid->points.point);
    project->rigid[index] = rigid->made;
    return is_there(error);
}

bool projector_upload_solid(Projector *project, int index, const RigidLayer *rigid, Error *error)
{
    if (project->solid_made[index] != rigid->made)
        send(project->solids[index], rigid->points.point, rigid->points.count * sizeof *rigid->points.point);
    project->solid_made[index] = rigid->made;
    return is_there(error);
}

/* Number of invocations that share the points of the largest piece. */
static unsigned parts_of(float largest)
{
    const float parts = ceilf(fminf(largest, EXPECTED_MOST) / (float)PIECE_POINTS_MOST);
    return (unsigned)fmaxf(1, fminf(parts, PIECE_PARTS_MOST));
}

/* In rows, since an axis may be limited to 65,535 groups. */
static void dispatch(size_t pieces, int sets)
{
    enum { GROUP = 64, ROW = 32768 };
    const size_t groups = (pieces + GROUP - 1) / GROUP, rows = (groups + ROW - 1) / ROW;
    glUniform1ui(PIECE_COUNT_AT, (GLuint)pieces);
    if (pieces > 0)
        glDispatchCompute((GLuint)(rows > 1 ? ROW : groups), (GLuint)rows, (GLuint)sets);
}

static void look(const SetSight *sight)
{
    glUniform4fv(PIECE_SIGHT_AT, 3, sight->row[0]);
    glUniform4f(PIECE_EYE_AT, sight->eye[0], sight->eye[1], sight->eye[2], sight->edges);
    glUniform2f(PIECE_RANGE_AT, sight->low, sight->scale);
}

static void project_layer(const Projector *project, int index, const LayerPieces *layer,
                          const SetSight *sight, const ProjectorSets *sets)
{
    const bool corners = !layer->on_gpu && layer->triangle_count > 0;
    const bool cells = layer->on_gpu ? layer->cells : !corners;
    const size_t pieces = layer->on_gpu ? layer->on_gpu : layer->point_count;
    const unsigned parts = parts_of(project->layers[index].largest);
    PieceRange range = {0};
    look(sight);
    glUniform1ui(PIECE_PARTS_AT, parts);
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, PIECE_POINTS_STORAGE, 3, project->layers[index].buffers);
    glUniform1ui(PIECE_KIND_AT, cells ? PIECE_CELLS : corners ? PIECE_TRIANGLES : PIECE_LOOSE);
    glUniform3ui(PIECE_SET_AT, (GLuint)sets->first, (GLuint)sets->count, 1);
    glUniform4f(PIECE_CELL_AT, (GLfloat)layer->cell[0], (GLfloat)layer->cell[1], (GLfloat)layer->cell[2],
                layer->slab ? 1 : 0);
    glUniform1ui(PIECE_FIRST_AT, 0);
    if (corners)
        dispatch(layer->triangle_count, sets->count * (int)parts);
    while (!corners &&
           projector_next_range(project, index, cells ? sizeof(LayerPoint) : 3 * sizeof(LayerPoint), pieces,
                                &range))
        dispatch(range.count, sets->count * (int)parts);
}

/* Dispatches as many points at a time as a block can hold; offsets are then multiples of 256 bytes, as
   bindings need. */
static void dispatch_still(const Projector *project, unsigned buffer, size_t count)
{
    enum { STEP = 32 };
    const size_t point = sizeof(SurfacePoint), most = (size_t)project->block_bytes / (STEP * point) * STEP;
    for (size_t first = 0; first < count; first += most) {
        const size_t some = count - first < most ? count - first : most;
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, PIECE_POINTS_STORAGE, buffer, (GLintptr)(first * point),
                          (GLsizeiptr)(some * point));
        glUniform1ui(PIECE_FIRST_AT, (GLuint)first);
        dispatch(some, 1);
    }
}

static void project_still(const Projector *project, const RigidLayer *rigid, unsigned buffer, float pixel,
                          const ProjectorSets *sets)
{
    static const GLfloat as_it_is[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const bool turns = rigid->polygons.vertex_count > 0;
    if (rigid->sets == 0 || rigid->count == 0)
        return;
    look(&rigid->sight);
    glUniformMatrix3fv(PIECE_TURN_AT, 1, GL_TRUE, turns ? rigid->turn[0] : as_it_is);
    glUniform1ui(PIECE_KIND_AT, PIECE_STILL);
    glUniform3ui(PIECE_SET_AT, (GLuint)sets->first, (GLuint)sets->count, (GLuint)rigid->sets);
    glUniform4f(PIECE_CELL_AT, (GLfloat)rigid->wanted, (GLfloat)rigid->density * pixel, 0, 0);
    dispatch_still(project, rigid->buffer ? rigid->buffer : buffer, rigid->count);
}

static void clear_sets(const Average *average, int count)
{
    static const GLuint zero = 0;
    const size_t pixels = (size_t)average->part[2] * (size_t)average->band[1];
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glClearNamedBufferSubData(average->sets, GL_R32UI, 0,
                              (GLsizeiptr)(2 * sizeof zero * pixels * (size_t)count), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, &zero);
}

void projector_run(Projector *project, const Average *average, const ProjectorSets *sets)
{
    clear_sets(average, sets->count);
    glUseProgram(project->program);
    glBindBufferBase(GL_UNIFORM_BUFFER, PBSR_BLOCK, average->block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SETS_STORAGE, average->sets);
    glUniform1ui(PIECE_SEED_AT, (GLuint)sets->seed);
    for (GLuint words = 0; words < 2; words++) {
        glUniform1ui(PIECE_WORDS_AT, words);
        for (int i = 0; i < sets->layer_count; i++) {
            glUniform1ui(PIECE_LAYER_AT, (GLuint)i);
            project_layer(project, i, layer_pieces(&sets->rigid[i], &sets->layers[i]),
                          layer_pieces_sight(&sets->rigid[i], &average->sight), sets);
            project_still(project, &sets->rigid[i], project->layers[i].buffers[PIECES_STILL],
                          average->sight.pixel, sets);
        }
        for (int i = 0; i < sets->solids->count; i++) {
            glUniform1ui(PIECE_LAYER_AT, sets->solids->numbers[i]);
            project_still(project, &sets->solids->rigid[i], project->solids[i], average->sight.pixel, sets);
        }
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
}

static uint64_t covered_by(const SetImage *image, size_t pixels)
{
    uint64_t covered = 0;
    for (size_t i = 0; i < pixels; i++)
        covered += image->depth[i] != 0;
    return covered;
}

/* Expected points of a set: nearer points are kept with higher probability. */
static double expected_of(const RigidLayer *rigid, const SetSight *sight)
{
    const float *row = sight->row[2];
    double all = 0;
    for (size_t i = 0; rigid->sets > 0 && i < rigid->points.count; i++) {
        const float *at = rigid->points.point[i].position;
        const double w = (double)(row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3]);
        const double have = rigid->density * (double)sight->pixel * w * w;
        const double wanted = rigid->wanted * (double)rigid_layer_boost(rigid, &rigid->points.point[i]);
        all += have > wanted ? wanted / have : 1;
    }
    return rigid->sets > 0 ? all / rigid->sets : 0;
}

/* Reads points from GL memory into `copy`; the caller frees copy->points. */
static bool set_in_view(const RigidLayer *rigid, RigidLayer *copy)
{
    *copy = *rigid;
    if (!rigid->buffer)
        return true;
    copy->points = (SurfacePoints){rigid->count, rigid->count, malloc(rigid->count * sizeof(SurfacePoint))};
    if (copy->points.point)
        glGetNamedBufferSubData(rigid->buffer, 0, (GLsizeiptr)(rigid->count * sizeof(SurfacePoint)),
                                copy->points.point);
    return copy->points.point != NULL;
}

/* Adds the points that a set has of a layer. */
static bool add_set(const LayerPieces *layer, const RigidLayer *rigid, const SetSight *sight,
                    const SetImage *image, double *points)
{
    RigidLayer copy;
    if (!set_in_view(rigid, &copy))
        return false;
    *points +=
        (double)layer_project(layer_pieces(rigid, layer), 0, 0, layer_pieces_sight(rigid, sight), image) +
        expected_of(&copy, &rigid->sight);
    rigid_layer_project(&copy, 0, 0, image);
    if (rigid->buffer)
        surface_points_free(&copy.points);
    return true;
}

bool count_set_points(const FluidLayers *layers, const FluidWalk walks[], const RigidLayer rigid[],
                      const SolidLayers *solids, const SetSight *sight, int sets, const Frame *frame)
{
    const size_t pixels = (size_t)sight->width * (size_t)sight->height;
    const SetImage image = {.depth = malloc(pixels * sizeof *image.depth),
                            .word = malloc(pixels * sizeof *image.word)};
    bool ok = image.depth && image.word;
    const LayerPieces none = {.point = NULL};
    double points = 0;
    if (ok)
        set_image_clear(&image, sight);
    for (int i = 0; ok && i < layers->count; i++)
        ok = walks[i].walks ? add_set(&none, &walks[i].rigid, sight, &image, &points)
                            : add_set(&layers->layers[i], &rigid[i], sight, &image, &points);
    for (int i = 0; ok && i < solids->count; i++)
        ok = add_set(&none, &solids->rigid[i], sight, &image, &points);
    if (ok) {
        frame->counts->fragments[STAGE_BLEND] = points * sets;
        counts_finish(frame->counts, covered_by(&image, pixels),
                      (uint64_t)frame->width * (uint64_t)frame->height);
    }
    free(image.depth);
    free(image.word);
    return ok;
}
