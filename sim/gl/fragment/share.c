/* Particles for the views: a pass draws to a texture, copied to a pixel buffer that is the vertex buffer;
   no data leaves the GPU. */
#include "sim/gl/fragment/fragment.h"
#include "sim/gl/particle_buffers.h"

#include <epoxy/gl.h>

/* Outputs of SHOW besides scalars. */
enum { SHOW_FLUID = SCALAR_STATE_COUNT, SHOW_ID };

static ParticleAttribute pack(Fragment *f, unsigned *buffer, unsigned texture, GLenum format, size_t stride)
{
    const size_t bytes = stride * (size_t)f->width * (size_t)f->height;
    if (!*buffer) {
        glCreateBuffers(1, buffer);
        glObjectLabel(GL_BUFFER, *buffer, -1, "shown");
        glNamedBufferStorage(*buffer, (GLsizeiptr)bytes, NULL, 0);
        f->bytes += bytes;
    }
    fragment_pack(texture, format, *buffer, 0, bytes);
    return (ParticleAttribute){*buffer, 0, stride};
}

static void draw(const Fragment *f, FragmentPass pass, unsigned target)
{
    fragment_sample(FRAGMENT_SAMPLE_POSITION, f->position[0]);
    fragment_sample(FRAGMENT_SAMPLE_VELOCITY, f->velocity[0]);
    fragment_sample(FRAGMENT_SAMPLE_FIELDS, f->fields);
    fragment_draw(f, pass, &target, 1, f->width, f->height);
}

static void show(Fragment *f, int what)
{
    glProgramUniform1i(f->program[FRAGMENT_SHOW], fragment_uniform(f, FRAGMENT_SHOW, FRAGMENT_scalar), what);
    draw(f, FRAGMENT_SHOW, f->word);
}

static void share_scalars(Fragment *f, unsigned attributes, ParticleBuffers *out)
{
    for (int s = 0; s < SCALAR_OWN; s++) {
        if (!(attributes & PARTICLE_SCALAR(s)))
            continue;
        show(f, s);
        out->scalar[s] = pack(f, &f->shown[s], f->word, GL_RED_INTEGER, 4);
    }
}

void fragment_share(void *state, unsigned attributes, ParticleBuffers *out)
{
    Fragment *f = state;
    fragment_watch_send(f);
    gl_state_keep(&f->kept);
    fragment_shown_create(f);
    draw(f, FRAGMENT_PLACE, f->placed);
    out->position = pack(f, &f->shown_position, f->placed, GL_RGBA, 16);
    if (attributes & PARTICLE_VELOCITY)
        out->velocity = pack(f, &f->shown_velocity, f->velocity[0], GL_RGBA, 16);
    share_scalars(f, attributes, out);
    if (attributes & PARTICLE_FLUID) {
        show(f, SHOW_FLUID);
        out->fluid = pack(f, &f->shown[SHOW_FLUID], f->word, GL_RED_INTEGER, 4);
    }
    if (attributes & PARTICLE_ID) {
        show(f, SHOW_ID);
        out->id = pack(f, &f->shown[SHOW_ID], f->word, GL_RED_INTEGER, 4);
    }
    gl_state_restore(&f->kept);
}
