#include "render/splat/narrow_range.h"

#include "render/splat/splat_def.h"
#include "shaders/splat/splat_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>
#include <stdio.h>

static GLuint create_smoothing(const char *label, const char *defines, Error *error)
{
    static const char *const stages[] = {"common/screen.vert", "splat/narrow_range.frag", NULL};
    char all[96];
    snprintf(all, sizeof all, "%s#define TAPS %d\n", defines, NARROW_RANGE_TAPS);
    return program_create(label, stages, all, error);
}

bool narrow_range_create(NarrowRange *filter, bool panes, Error *error)
{
    static const char *const normals[] = {"common/screen.vert", "splat/narrow_range_normals.frag", NULL};
    *filter = (NarrowRange){0};
    glCreateVertexArrays(1, &filter->screen);
    filter->along = create_smoothing("narrow range", "", error);
    if (filter->along)
        filter->clean = create_smoothing("narrow range, clean-up", "#define CLEAN 1\n", error);
    if (filter->clean)
        filter->normals =
            program_create("narrow range, normals", normals, panes ? "#define PANES 1\n" : NULL, error);
    return filter->normals != 0;
}

static void delete_maps(NarrowRange *filter)
{
    glDeleteFramebuffers(2, filter->depth_framebuffer);
    glDeleteFramebuffers(1, &filter->normal_framebuffer);
    glDeleteTextures(2, filter->depth);
    glDeleteTextures(1, &filter->normal);
}

void narrow_range_destroy(NarrowRange *filter)
{
    delete_maps(filter);
    glDeleteProgram(filter->along);
    glDeleteProgram(filter->clean);
    glDeleteProgram(filter->normals);
    glDeleteVertexArrays(1, &filter->screen);
    *filter = (NarrowRange){0};
}

static void follow(NarrowRange *filter, const Target *target)
{
    if (filter->target_number == target->number)
        return;
    delete_maps(filter);
    for (int i = 0; i < 2; i++) {
        filter->depth[i] = splat_map_create(GL_R32F, target, "narrow range depth");
        filter->depth_framebuffer[i] = splat_framebuffer_create(&filter->depth[i], 1, "narrow range depth");
    }
    filter->normal =
        splat_map_create(gl_renderer_is_software() ? GL_RGBA32F : GL_RGBA16F, target, "narrow range normal");
    filter->normal_framebuffer = splat_framebuffer_create(&filter->normal, 1, "narrow range normal");
    filter->target_number = target->number;
}

/* Smooths `from` into depth[to]; returns depth[to]. */
static unsigned smooth(const NarrowRange *filter, GLuint program, unsigned from, int to, int x, int y)
{
    glBindFramebuffer(GL_FRAMEBUFFER, filter->depth_framebuffer[to]);
    glBindTextureUnit(NEAREST_UNIT, from);
    glUseProgram(program);
    glUniform2i(FILTER_AXIS_AT, x, y);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    return filter->depth[to];
}

static void set_uniforms(const NarrowRange *filter, const Frame *frame)
{
    const SplatDef *def = splat_def(frame->def);
    const float radius = frame->particle_radius, range = (float)def->filter_range * radius;
    const float pixels = 0.5F * (float)frame->height / frame->camera.tangent[1]; /* pixels of 1 m at a
                                                                                    distance of 1 m */
    const float reach = (float)def->filter_size * radius * pixels;
    for (int i = 0; i < 2; i++) {
        const GLuint program = i == 0 ? filter->along : filter->clean;
        glProgramUniform1f(program, FILTER_REACH_AT, reach);
        glProgramUniform1f(program, FILTER_RANGE_AT, range);
    }
    glProgramUniform1f(filter->normals, EDGE_STEP_AT,
                       0.5F * range); /* filtering brings the rim of a gap of one range nearer */
}

SplatMaps narrow_range_draw(NarrowRange *filter, const SplatMaps *maps, const Frame *frame)
{
    SplatMaps shown = *maps;
    follow(filter, frame->target);
    set_uniforms(filter, frame);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glBindVertexArray(filter->screen);
    glViewport(0, 0, frame->width, frame->height);
    for (int i = 0; i < 2; i++)
        glClearNamedFramebufferfv(filter->depth_framebuffer[i], GL_COLOR, 0, (GLfloat[4]){SPLAT_NOTHING});
    frame_cut_to_bounds(frame);
    for (int i = 0; i < splat_def(frame->def)->filter_iterations; i++) {
        shown.nearest = smooth(filter, filter->along, shown.nearest, 0, 1, 0);
        shown.nearest = smooth(filter, filter->along, shown.nearest, 1, 0, 1);
    }
    shown.nearest = smooth(filter, filter->clean, shown.nearest, 0, 0, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, filter->normal_framebuffer);
    glBindTextureUnit(NEAREST_UNIT, shown.nearest);
    glBindTextureUnit(NORMAL_SUM_UNIT, maps->normal);
    glUseProgram(filter->normals);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
    shown.normal = filter->normal;
    return shown;
}
