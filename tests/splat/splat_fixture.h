/* Common parts of the splat tests: fixed particles, the maps of the passes, and the paper's equations in
   double. */
#ifndef SLOSH_SPLAT_FIXTURE_H
#define SLOSH_SPLAT_FIXTURE_H

#include "tests/render/fixture.h"

#include "render/frame/frame.h"
#include "render/views/splat/splat_private.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>

/* What stood for the particles in the last drawing that had ellipsoids or drops:
 * shaders/common/ball.glsl. */
static __attribute__((unused)) float splat_shapes[12 * PARTICLES_MAX];

typedef struct SplatScene {
    ViewDef def;
    WorldDef world;
    ParticleBuffers state;
    Particles *particles;
    int width, height;
    bool empty;  /* as if there were no particles; an upload has at least one */
    Frame frame; /* of the last drawing */
} SplatScene;

/* Of a pixel, row by row from below; what nothing covers has weight 0. */
typedef struct SplatPixel {
    double depth; /* m; 1e30 where nothing is */
    double color[3], normal[3], weight;
    double shown_depth, shown_normal[3]; /* what is shaded: after a filter, if there is one */
    double slope; /* of the nearest sphere's depth there: 1 / sqrt(1 - rho^2), by which rounding grows */
    bool unsure;  /* so near a rim or a limit that rounding decides */
} SplatPixel;

static inline SplatScene splat_scene(const double from[3], const double to[3], double fov_deg, double radius)
{
    SplatScene scene = {.def = bare_view(),
                        .world = bare_world(),
                        .particles = calloc(1, sizeof(Particles)),
                        .width = 160,
                        .height = 120};
    assert_non_null(scene.particles);
    text_set(scene.def.kind, "splat");
    scene.def.color_by = SCALAR_FLUID;
    scene.def.camera_auto = false;
    memcpy(scene.def.camera.from, from, sizeof scene.def.camera.from);
    memcpy(scene.def.camera.to, to, sizeof scene.def.camera.to);
    scene.def.camera.fov_deg = fov_deg;
    scene.def.radius = 1;
    splat_def(&scene.def)->antialias = false; /* spheres as they are, however small */
    scene.state = box_state(0, radius);
    return scene;
}

static inline float *read_map(unsigned map, unsigned format, int count, int components)
{
    float *values = calloc((size_t)count, (size_t)components * sizeof *values);
    assert_non_null(values);
    glGetTextureImage(map, 0, format, GL_FLOAT, count * components * (int)sizeof *values, values);
    return values;
}

static inline void read_depth(const SplatMaps *maps, SplatPixel *pixels, int count)
{
    float *depth = read_map(maps->nearest, GL_RED, count, 1);
    for (int i = 0; i < count; i++)
        pixels[i].depth = depth[i];
    free(depth);
}

static inline void read_sums(const SplatMaps *maps, SplatPixel *pixels, int count)
{
    float *color = read_map(maps->color, GL_RGB, count, 3),
          *normal = read_map(maps->normal, GL_RGB, count, 3);
    float *weight = read_map(maps->weight, GL_RED, count, 1);
    for (int i = 0; i < count; i++) {
        pixels[i].weight = weight[i];
        for (int k = 0; k < 3; k++)
            pixels[i].color[k] = color[3 * i + k], pixels[i].normal[k] = normal[3 * i + k];
    }
    free(color);
    free(normal);
    free(weight);
}

static inline void read_shapes(const Ellipsoids *ellipsoids, size_t count)
{
    const size_t floats = ellipsoids->def.shape == SPLAT_ELLIPSOID ? 12 : 1;
    if (ellipsoids_wanted(&ellipsoids->def) && count > 0)
        glGetNamedBufferSubData(ellipsoids->shapes, 0, (GLsizeiptr)(count * floats * sizeof(float)),
                                splat_shapes);
}

static inline void read_shown(const SplatMaps *maps, SplatPixel *pixels, int count)
{
    float *depth = read_map(maps->nearest, GL_RED, count, 1),
          *normal = read_map(maps->normal, GL_RGB, count, 3);
    for (int i = 0; i < count; i++) {
        pixels[i].shown_depth = depth[i];
        for (int k = 0; k < 3; k++)
            pixels[i].shown_normal[k] = normal[3 * i + k];
    }
    free(depth);
    free(normal);
}

/* The view after drawing a scene into a test target; splat_close ends the view. */
typedef struct SplatDrawing {
    void *view;
    Target target;
    Upload *upload;
    Neighbourhood *neighbourhood; /* of the frame */
    unsigned uniforms;
} SplatDrawing;

/* The target's content before the view draws; NULL: arbitrary. */
typedef void SplatGround(const Target *target);

static inline SplatDrawing splat_open(SplatScene *scene, SplatGround *ground, bool plain)
{
    Error error = {0};
    ParticleBuffers buffers;
    SplatDrawing drawing = {.view = view_splat.create(&(Subject){&scene->def, &scene->world}, &error)};
    if (!drawing.view || !target_create(&drawing.target, scene->width, scene->height, &error))
        fail_msg("%s", error.message);
    scene->state.count = scene->particles->count;
    drawing.upload = upload_particles(scene->particles, &scene->state, &buffers);
    buffers.count = scene->empty ? 0 : buffers.count;
    frame_make(&scene->frame, &(Subject){&scene->def, &scene->world}, &buffers, &drawing.target,
               view_radii(&view_splat, &scene->def, &buffers), (CoveredParts){0});
    drawing.neighbourhood = calloc(1, sizeof *drawing.neighbourhood);
    assert_true(drawing.neighbourhood && neighbourhood_create(drawing.neighbourhood, &error));
    scene->frame.neighbourhood = drawing.neighbourhood;
    scene->frame.plain = plain;
    scene->frame.floor.light = no_shadows();
    drawing.uniforms = frame_uniforms_create();
    frame_uniforms_update(drawing.uniforms, &scene->frame, buffers.box_size, buffers.spacing);
    target_begin(&drawing.target);
    view_splat.prepare(drawing.view, &buffers, &scene->frame);
    view_splat.cast(drawing.view, &buffers, &scene->frame);
    target_begin(&drawing.target);
    if (ground)
        ground(&drawing.target);
    view_splat.draw(drawing.view, &buffers, &scene->frame);
    return drawing;
}

static inline void splat_close(SplatDrawing *drawing)
{
    glDeleteBuffers(1, &drawing->uniforms);
    neighbourhood_destroy(drawing->neighbourhood);
    free(drawing->neighbourhood);
    upload_destroy(drawing->upload);
    target_destroy(&drawing->target);
    view_splat.destroy(drawing->view);
}

/* width * height pixels, which the caller frees. */
static inline SplatPixel *splat_read(const SplatScene *scene, const SplatDrawing *drawing)
{
    const int count = scene->width * scene->height;
    SplatPixel *pixels = calloc((size_t)count, sizeof *pixels);
    assert_non_null(pixels);
    read_depth(splat_maps(drawing->view), pixels, count);
    read_sums(splat_maps(drawing->view), pixels, count);
    read_shapes(splat_ellipsoids(drawing->view), scene->empty ? 0 : scene->particles->count);
    read_shown(splat_shown_maps(drawing->view), pixels, count);
    return pixels;
}

/* The same of a scene that is drawn for it. */
static inline SplatPixel *splat_drawn(SplatScene *scene)
{
    SplatDrawing drawing = splat_open(scene, NULL, false);
    SplatPixel *pixels = splat_read(scene, &drawing);
    splat_close(&drawing);
    return pixels;
}

static inline double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Of a sphere on a ray. */
typedef struct SplatHit {
    double depth, rho; /* rho: how far beside the centre the ray is, in radii */
    double normal[3];
} SplatHit;

/* Exact: the first point of the sphere on the ray. */
static inline SplatHit hit_perspective(const double c[3], double r, const double ray[3])
{
    const double dd = dot3(ray, ray), b = dot3(ray, c), q = dot3(c, c) - r * r;
    const double t = (b - sqrt(fmax(b * b - dd * q, 0))) / dd;
    SplatHit hit = {.depth = q > 0 && b > 0 ? t : -1, .rho = sqrt(fmax(dot3(c, c) - b * b / dd, 0)) / r};
    for (int k = 0; k < 3; k++)
        hit.normal[k] = (t * ray[k] - c[k]) / r;
    return hit;
}

/* Eq. 5: x is where the ray meets the square through the centre. */
static inline SplatHit hit_paper(const double c[3], double r, const double ray[3])
{
    const double w = -c[2], dx = w * ray[0] - c[0], dy = w * ray[1] - c[1];
    const double root = sqrt(fmax(r * r - dx * dx - dy * dy, 0));
    return (SplatHit){w > 0 ? w - root : -1, sqrt(dx * dx + dy * dy) / r, {dx / r, dy / r, root / r}};
}

/* The symmetric matrix of an ellipsoid, in the eye's frame. */
static inline void inverse_in_eye(const SplatScene *scene, const float shape[12], double a[3][3])
{
    static const int at[3][3] = {{4, 8, 9}, {8, 5, 10}, {9, 10, 6}};
    float turn[16];
    matrix_multiply(scene->frame.camera.view, scene->frame.box_to_world, turn);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            a[i][j] = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    a[i][j] += (double)turn[4 * k + i] * shape[at[k][l]] * turn[4 * l + j];
        }
}

static inline void multiply3(double a[3][3], const double x[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = dot3(a[i], x);
}

/* By turning the ray into the frame where it is a sphere; a normal goes back by the inverse transpose. */
static inline SplatHit hit_ellipsoid(const SplatScene *scene, const float shape[12], const double c[3],
                                     const double ray[3])
{
    double a[3][3], centre[3], along[3], normal[3];
    const double beside2 = dot3(c, c) - dot3(c, ray) * dot3(c, ray) / dot3(ray, ray);
    if (beside2 > ELLIPSOID_REACH * ELLIPSOID_REACH * shape[3] * shape[3])
        return (SplatHit){.depth = -1, .rho = 2};
    inverse_in_eye(scene, shape, a);
    multiply3(a, c, centre);
    multiply3(a, ray, along);
    SplatHit hit = hit_perspective(centre, shape[3], along);
    multiply3(a, hit.normal, normal);
    for (int k = 0; k < 3; k++)
        hit.normal[k] = normal[k] / sqrt(dot3(normal, normal));
    return hit;
}

static inline SplatHit hit_of(const SplatScene *scene, size_t particle, double x, double y)
{
    const Camera *camera = &scene->frame.camera;
    const double ray[3] = {(2 * (x + 0.5) / scene->width - 1) * camera->tangent[0],
                           (2 * (y + 0.5) / scene->height - 1) * camera->tangent[1], -1};
    float at[3];
    const bool ellipsoid = splat_def(&scene->def)->shape == SPLAT_ELLIPSOID;
    const float *shape = &splat_shapes[12 * particle];
    memcpy(at, ellipsoid ? shape : &scene->particles->position[4 * particle], sizeof at);
    matrix_transform(scene->frame.box_to_world, at, at);
    matrix_transform(camera->view, at, at);
    const double c[3] = {at[0], at[1], at[2]},
                 r = splat_def(&scene->def)->drops ? splat_shapes[particle] : scene->frame.radii.drawn;
    if (ellipsoid)
        return hit_ellipsoid(scene, shape, c, ray);
    return splat_def(&scene->def)->shape == SPLAT_PAPER ? hit_paper(c, r, ray) : hit_perspective(c, r, ray);
}

static inline bool hit_counts(const SplatScene *scene, const SplatHit *hit)
{
    return hit->rho < 1 && hit->depth >= scene->frame.camera.near_plane; /* not for NaN */
}

/* Eq. 6 and 7. */
static inline double weight_of(const SplatScene *scene, const SplatHit *hit, double nearest, double eps)
{
    const double least = 1e-4; /* splat_blend.frag */
    switch (splat_def(&scene->def)->weights) {
    case SPLAT_NO_WEIGHTS:
        return hit->depth <= nearest;
    case SPLAT_W1:
        return fmax(1 - hit->rho, least);
    case SPLAT_W2:
        return fmax((nearest + eps - hit->depth) / eps, least);
    default:
        return fmax((1 - hit->rho) * (nearest + eps - hit->depth) / eps, least);
    }
}

/* Eq. 8 to 10 with all particles. */
static inline SplatPixel splat_wanted(const SplatScene *scene, double x, double y)
{
    SplatPixel pixel = {.depth = 1e30};
    const double eps = splat_def(&scene->def)->eps * scene->frame.radii.drawn;
    for (size_t i = 0; i < scene->particles->count; i++) {
        const SplatHit hit = hit_of(scene, i, x, y);
        pixel.unsure |= fabs(hit.rho - 1) < 1e-3;
        if (hit_counts(scene, &hit) && hit.depth < pixel.depth)
            pixel.depth = hit.depth, pixel.slope = 1 / sqrt(1 - hit.rho * hit.rho);
    }
    for (size_t i = 0; i < scene->particles->count; i++) {
        const SplatHit hit = hit_of(scene, i, x, y);
        const float *color = scene->world.fluids[scene->particles->fluid[i]].color;
        if (!hit_counts(scene, &hit) || hit.depth >= pixel.depth + eps)
            continue;
        const double weight = weight_of(scene, &hit, pixel.depth, eps);
        pixel.unsure |= fabs(hit.depth - pixel.depth - eps) < 1e-4 * eps ||
                        (hit.depth > pixel.depth && hit.depth < pixel.depth * (1 + 1e-5));
        pixel.weight += weight;
        for (int k = 0; k < 3; k++)
            pixel.color[k] += weight * color[k], pixel.normal[k] += weight * hit.normal[k];
    }
    return pixel;
}

/* Sums of half precision, as hardware has them, are rounded by up to 1e-3 at each term: of a dozen of these.
 */
static inline double splat_rounding(void)
{
    return gl_renderer_is_software() ? 1 : 5;
}

typedef SplatPixel (*SplatFormula)(const SplatScene *scene, double x, double y);

/* Greatest differences of the formula over hardware pixel positions (fixture.h), per number. False if a
   number is uncertain. */
static inline bool splat_snap(const SplatScene *scene, SplatFormula formula, int x, int y,
                              const SplatPixel *wanted, SplatPixel *slack)
{
    *slack = (SplatPixel){.depth = 0};
    for (int k = 0; snaps() && k < SNAP_PLACES; k++) {
        double by[2];
        snap_place(k, by);
        const SplatPixel beside = formula(scene, x + by[0], y + by[1]);
        if (beside.unsure || (beside.depth < 1e29) != (wanted->depth < 1e29))
            return false;
        slack->depth = fmax(slack->depth, fabs(beside.depth - wanted->depth));
        slack->weight = fmax(slack->weight, fabs(beside.weight - wanted->weight));
        for (int c = 0; c < 3; c++) {
            slack->color[c] = fmax(slack->color[c], fabs(beside.color[c] - wanted->color[c]));
            slack->normal[c] = fmax(slack->normal[c], fabs(beside.normal[c] - wanted->normal[c]));
        }
    }
    return true;
}

/* Depth to 32 bits' precision, sums to 16 bits' of some terms. Returns how many pixels are covered. */
static inline int splat_compare(SplatScene *scene)
{
    SplatPixel *drawn = splat_drawn(scene);
    const bool ellipsoid =
        splat_def(&scene->def)->shape == SPLAT_ELLIPSOID; /* stretched, rounding included */
    int covered = 0;
    for (int i = 0; i < scene->width * scene->height; i++) {
        const int x = i % scene->width, y = i / scene->width;
        const SplatPixel wanted = splat_wanted(scene, x, y);
        covered += drawn[i].depth < 1e29;
        SplatPixel snap;
        if (wanted.unsure || !splat_snap(scene, splat_wanted, x, y, &wanted, &snap))
            continue;
        const double slack = snap.depth + 5e-7 * (wanted.depth + (ellipsoid ? 8 : 2) * wanted.slope *
                                                                     scene->frame.radii.drawn);
        if (fabs(drawn[i].depth - wanted.depth) > slack)
            fail_msg("pixel %d %d: depth %.9g, formula %.9g", x, y, drawn[i].depth, wanted.depth);
        const double most =
            2e-3 * (0.05 + wanted.weight) * (ellipsoid || splat_def(&scene->def)->drops ? 6 : 1);
        const double sums = splat_rounding() * most;
        if (fabs(drawn[i].weight - wanted.weight) > (snaps() ? most : most / 10) + snap.weight)
            fail_msg("pixel %d %d: weight %g, formula %g", x, y, drawn[i].weight, wanted.weight);
        for (int k = 0; k < 3; k++)
            if (fabs(drawn[i].color[k] - wanted.color[k]) > sums + snap.color[k] ||
                fabs(drawn[i].normal[k] - wanted.normal[k]) > sums + snap.normal[k])
                fail_msg("pixel %d %d, component %d: colour %g, formula %g; normal %g, formula %g", x, y, k,
                         drawn[i].color[k], wanted.color[k], drawn[i].normal[k], wanted.normal[k]);
    }
    free(drawn);
    return covered;
}

#endif
