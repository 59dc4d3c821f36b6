/* Hidden spheres are drawn too. Culling gained nothing on the software driver: exact occluders cost 1.2 ms
   and hide nothing, since gaps between touching spheres show several layers. */
#include "render/views/spheres/spheres.h"

#include "render/frame/frame.h"
#include "render/particles/particles.h"
#include "shaders/shared/bindings.h"
#include "shaders/spheres/spheres_bindings.h"
#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct Spheres {
    GLuint visibility, points, shading; /* programs */
    ParticleCurves curves;
    ShadowCaster casting;
    float point_sprite_limit; /* largest point, pixels; 0: quads only */
    bool solids;              /* the target contains more than particles */
    ColorTable colors;
    GLuint framebuffer, seen; /* R32UI: number of the nearest particle, valid where the target's depth is a
                                 particle's */
    unsigned target_number;   /* number of the target of the framebuffer */
    GLuint screen;            /* vertex array without attributes */
    QuadIndices quads;
} Spheres;

static void spheres_destroy(void *state)
{
    Spheres *spheres = state;
    glDeleteProgram(spheres->visibility);
    glDeleteProgram(spheres->points);
    glDeleteProgram(spheres->shading);
    shadow_caster_destroy(&spheres->casting);
    particle_curves_destroy(&spheres->curves);
    color_table_destroy(&spheres->colors);
    glDeleteFramebuffers(1, &spheres->framebuffer);
    glDeleteTextures(1, &spheres->seen);
    glDeleteVertexArrays(1, &spheres->screen);
    quad_indices_destroy(&spheres->quads);
    free(spheres);
}

static bool create_programs(Spheres *spheres, const ViewDef *def, Error *error)
{
    static const char *const quads[] = {"spheres/spheres.vert", "spheres/spheres.frag", NULL};
    static const char *const points[] = {"spheres/spheres_point.vert", "spheres/spheres_point.frag", NULL};
    static const char *const shading[] = {"common/screen.vert", "spheres/spheres_shade.frag", NULL};
    const char *curves = particle_curves_defines(def);
    char defines[96];
    snprintf(defines, sizeof defines, "%s%s", curves, spheres->solids ? "#define SOLIDS 1\n" : "");
    spheres->visibility = program_create("spheres", quads, curves, error);
    if (spheres->visibility)
        spheres->points = program_create("spheres point", points, curves, error);
    if (spheres->points)
        spheres->shading = program_create("spheres shade", shading, defines, error);
    return spheres->shading && shadow_caster_create(&spheres->casting, curves, error);
}

static void *spheres_create(const Subject *subject, Error *error)
{
    const ViewDef *def = subject->def;
    Spheres *spheres = calloc(1, sizeof *spheres);
    if (!spheres) {
        error_set(error, "out of memory for the view");
        return NULL;
    }
    spheres->solids = subject->world->solid_count > 0;
    glCreateVertexArrays(1, &spheres->screen);
    quad_indices_create(&spheres->quads);
    spheres->point_sprite_limit = point_sprite_limit();
    if (color_table_create(&spheres->colors, view_colormap(def), &def->color_curve, error) &&
        particle_curves_create(&spheres->curves, def, error) && create_programs(spheres, def, error))
        return spheres;
    spheres_destroy(spheres);
    return NULL;
}

static void follow_target(Spheres *spheres, const Target *target)
{
    if (spheres->target_number == target->number)
        return;
    glDeleteFramebuffers(1, &spheres->framebuffer);
    glDeleteTextures(1, &spheres->seen);
    glCreateTextures(GL_TEXTURE_2D, 1, &spheres->seen);
    glTextureStorage2D(spheres->seen, 1, GL_R32UI, target->width, target->height);
    glTextureParameteri(spheres->seen, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(spheres->seen, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glObjectLabel(GL_TEXTURE, spheres->seen, -1, "seen particles");
    glCreateFramebuffers(1, &spheres->framebuffer);
    glObjectLabel(GL_FRAMEBUFFER, spheres->framebuffer, -1, "seen particles");
    glNamedFramebufferTexture(spheres->framebuffer, GL_COLOR_ATTACHMENT0, spheres->seen, 0);
    glNamedFramebufferTexture(spheres->framebuffer, GL_DEPTH_ATTACHMENT, target->depth, 0);
    spheres->target_number = target->number;
}

static void spheres_prepare(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    Spheres *spheres = state;
    if (frame->def->size.by != 0 || frame->def->opacity.by != 0)
        GL_STAGE(frame->timer, STAGE_VISIBILITY)
        {
            particle_curves_make(&spheres->curves, particles, frame);
        }
}

/* In two dimensions, balls that just touch leave holes, a moire in the picture: half the diagonal of a square
   of neighbours leaves none. */
static void spheres_radii(const ViewDef *def, const ParticleBuffers *particles, ParticleRadii *radii)
{
    if (def->radius == 0 && frame_slab_depth(particles) > 0)
        radii->drawn = radii->reach = (float)(sqrt(0.5) * particles->spacing);
    radii->reach *= (float)particle_curves_reach(def, particles);
}

static void spheres_cast(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    const Spheres *spheres = state;
    (void)frame;
    particle_curves_bind(&spheres->curves);
    shadow_caster_draw(&spheres->casting, particles);
}

/* True if GL points are usable: points with a centre outside the view are lost, and no point may be larger
   than the limit. */
static bool points_will_do(const Spheres *spheres, const Frame *frame)
{
    const float *tangent = frame->camera.tangent, r = frame->radii.reach, nearest = frame->extent.nearest + r;
    if (!frame->extent.all_in_view || nearest <= 2 * r)
        return false;
    float slant = sqrtf(1 + camera_max_slant_squared(&frame->camera));
    float half = r * slant / (nearest - r) / tangent[1] * (float)frame->height / 2;
    return 2 * half + 1 <= spheres->point_sprite_limit;
}

static void find_visible(Spheres *spheres, const ParticleBuffers *particles, const Frame *frame)
{
    static const GLuint none = UINT32_MAX;
    if (spheres->solids)
        glClearNamedFramebufferuiv(spheres->framebuffer, GL_COLOR, 0, &none);
    glBindFramebuffer(GL_FRAMEBUFFER, spheres->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    bool points = points_will_do(spheres, frame);
    GLuint program = points ? spheres->points : spheres->visibility;
    particle_curves_bind(&spheres->curves);
    glUseProgram(program);
    particle_bind(program, particles, view_color_by(frame->def));
    if (!points) {
        glUniform1ui(LAST_AT, (GLuint)particles->count - 1);
        quad_indices_draw(&spheres->quads, particles->count);
        return;
    }
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(spheres->screen);
    glDrawArrays(GL_POINTS, 0, (GLsizei)particles->count);
}

/* The triangle at depth 0 passes the test where something has been drawn; the shader skips solids. */
static void shade_visible(Spheres *spheres, const ParticleBuffers *particles, const Frame *frame)
{
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
    glBindTextureUnit(SEEN_UNIT, spheres->seen);
    color_table_bind(&spheres->colors, &frame->def->color_curve);
    particle_curves_bind(&spheres->curves);
    glUseProgram(spheres->shading);
    particle_bind(spheres->shading, particles, view_color_by(frame->def));
    glBindVertexArray(spheres->screen);
    frame_set_scissor(frame);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

static void spheres_draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    Spheres *spheres = state;
    follow_target(spheres, frame->target);
    GL_STAGE(frame->timer, STAGE_VISIBILITY)
    find_visible(spheres, particles, frame);
    GL_STAGE(frame->timer, STAGE_SHADE)
    if (particles->count > 0)
        shade_visible(spheres, particles, frame);
}

/* Opacity is ignored: where balls overlap, the value may be of a ball that is not drawn there. */
static ViewProbing spheres_probing(const void *state, const ViewDef *def)
{
    const Spheres *spheres = state;
    return (ViewProbing){VIEW_PROBE_BALL, def->size.by != 0 ? spheres->curves.size.values : 0};
}

const ViewKind view_spheres = {
    .name = "spheres",
    .help = "every particle as a lit sphere, exact in each pixel",
    .radius = 0.5, /* half a spacing: neighbours at rest touch */
    .curves = VIEW_OPACITY | VIEW_SIZE,
    .radii = spheres_radii,
    .create = spheres_create,
    .destroy = spheres_destroy,
    .prepare = spheres_prepare,
    .cast = spheres_cast,
    .draw = spheres_draw,
    .probing = spheres_probing,
};
