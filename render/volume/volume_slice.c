#include "render/volume/volume_slice.h"

#include "shaders/shared/bindings.h"
#include "shaders/volume/volume_bindings.h"
#include "sim/gl/program.h"

#include <epoxy/gl.h>

bool volume_slice_create(VolumeSlice *slice, const ViewDef *def, const Voxelizer *voxelizer, Error *error)
{
    static const char *const stages[] = {"volume/volume_slice.vert", "volume/volume_slice.frag", NULL};
    *slice = (VolumeSlice){.program = 0};
    if (!color_table_create(&slice->colors, view_colormap(def), &def->color_curve, error))
        return false;
    glCreateVertexArrays(1, &slice->vertex_array);
    slice->program = program_create("volume slice", stages, voxelizer_defines(voxelizer), error);
    return slice->program != 0;
}

void volume_slice_destroy(VolumeSlice *slice)
{
    glDeleteProgram(slice->program);
    glDeleteVertexArrays(1, &slice->vertex_array);
    color_table_destroy(&slice->colors);
    *slice = (VolumeSlice){0};
}

void volume_slice_draw(VolumeSlice *slice, const double box_size[3], const Frame *frame)
{
    const VolumeDef *def = volume_def(frame->def);
    const int axis = def->slice_axis;
    const double from = axis == 1 ? 0 : -box_size[axis] / 2;
    glBindFramebuffer(GL_FRAMEBUFFER, frame->target->framebuffer);
    glViewport(0, 0, frame->width, frame->height);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glUseProgram(slice->program);
    glUniform1ui(SLICE_AXIS_AT, (GLuint)axis);
    glUniform1f(SLICE_PLACE_AT, (float)(from + def->slice * box_size[axis]));
    color_table_bind(&slice->colors, &frame->def->color_curve);
    glBindVertexArray(slice->vertex_array);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}
