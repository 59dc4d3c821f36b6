#include "app/run/offscreen.h"

#include "app/base/program.h"
#include "sim/gpu/gl.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct Headless {
    EGLDisplay display;
    EGLContext context;
    char renderer[256];
};

enum { MISSING_SIZE = 160 };

/* The reason why OpenGL has no GPU on this machine, as far as files tell. */
static const char *what_is_missing(char text[MISSING_SIZE])
{
    glob_t nodes = {0};
    const bool node = glob("/dev/dri/renderD*", 0, NULL, &nodes) == 0;
    if (node && access(nodes.gl_pathv[0], R_OK | W_OK) != 0)
        snprintf(text, MISSING_SIZE, "no right to use %.40s (its group is `render` on most systems)",
                 nodes.gl_pathv[0]);
    else if (access("/dev/nvidiactl", F_OK) == 0)
        snprintf(text, MISSING_SIZE,
                 "an NVIDIA GPU is here, but not its OpenGL driver (libnvidia-egl; in a "
                 "container: the capability `graphics`)");
    else if (node)
        snprintf(text, MISSING_SIZE, "no OpenGL driver for %.40s", nodes.gl_pathv[0]);
    else
        snprintf(text, MISSING_SIZE, "this machine shows no GPU");
    globfree(&nodes);
    return text;
}

void renderer_tell(const char *name)
{
    char missing[MISSING_SIZE];
    if (gl_renderer_is_software())
        fprintf(stderr, "renderer: %s; software: %s\n", name, what_is_missing(missing));
    else
        fprintf(stderr, "renderer: %s\n", name);
}

/* Without the extension, a driver lists its own GPUs alone. */
static bool is_software(EGLDeviceEXT device)
{
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base") &&
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_query"))
        return false;
    const char *extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    return extensions && strstr(extensions, "EGL_MESA_device_software");
}

/* Lists hardware devices before software devices, each in the order of the driver; `gpus` gets the number of
   hardware devices. */
static int list_devices(EGLDeviceEXT sorted[HEADLESS_GPUS_MAX], int *gpus)
{
    EGLDeviceEXT devices[HEADLESS_GPUS_MAX];
    EGLint count = 0;
    int filled = 0;
    *gpus = 0;
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base") &&
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration"))
        return 0;
    if (!eglQueryDevicesEXT(HEADLESS_GPUS_MAX, devices, &count))
        return 0;
    for (int software = 0; software < 2; software++) {
        for (int i = 0; i < count; i++)
            if (is_software(devices[i]) == (software == 1))
                sorted[filled++] = devices[i];
        if (!software)
            *gpus = filled;
    }
    return filled;
}

static EGLContext create_context(EGLDisplay display)
{
    static const EGLint config_wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                           EGL_OPENGL_BIT, EGL_NONE};
    static const EGLint context_wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                            4,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            5,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
    EGLConfig config = NULL;
    EGLint count = 0;
    if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display, config_wanted, &config, 1, &count) ||
        count < 1)
        return EGL_NO_CONTEXT;
    return eglCreateContext(display, config, EGL_NO_CONTEXT, context_wanted);
}

/* A display belongs to the process: EGL returns the same display each time, and Mesa 22 leaks on
   eglTerminate. */
static Headless *open_display(EGLDisplay display)
{
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, NULL, NULL))
        return NULL;
    EGLContext context = create_context(display);
    Headless *headless = context == EGL_NO_CONTEXT ? NULL : calloc(1, sizeof *headless);
    if (headless && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        headless->display = display;
        headless->context = context;
        gl_context_begin();
        snprintf(headless->renderer, sizeof headless->renderer, "%s", (const char *)glGetString(GL_RENDERER));
        return headless;
    }
    free(headless);
    if (context != EGL_NO_CONTEXT)
        eglDestroyContext(display, context);
    return NULL;
}

/* Uses the extension's entry: libepoxy's core eglGetPlatformDisplay aborts while no display exists. */
static Headless *open_device(EGLDeviceEXT device)
{
    return open_display(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, NULL));
}

static Headless *open_surfaceless(void)
{
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        return NULL;
    return open_display(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL));
}

Headless *headless_create(int gpu, Error *error)
{
    driver_error_install();
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
        error_set(error, "EGL cannot make a context without a display here; install Mesa (libegl-mesa0 and "
                         "libgl1-mesa-dri) or a driver with EGL_EXT_platform_base");
        return NULL;
    }
    EGLDeviceEXT devices[HEADLESS_GPUS_MAX];
    int gpus, count = list_devices(devices, &gpus);
    if (gpu >= gpus || gpu < HEADLESS_GPU_AUTO) {
        char missing[MISSING_SIZE];
        if (gpus > 0)
            error_set(error, "there is no GPU %d; EGL has %d here, counted from 0", gpu, gpus);
        else
            error_set(error, "there is no GPU %d: %s; without --gpu a software driver will do", gpu,
                      what_is_missing(missing));
        return NULL;
    }
    Headless *headless = NULL;
    for (int i = gpu < 0 ? 0 : gpu; !headless && i < (gpu < 0 ? count : gpu + 1); i++)
        headless = open_device(devices[i]);
    if (!headless && gpu < 0)
        headless = open_surfaceless();
    if (!headless && gpu < 0)
        error_set(error,
                  "no OpenGL 4.5 context without a display: tried %d EGL devices and the surfaceless "
                  "platform; Mesa's software driver (libgl1-mesa-dri) would do",
                  count);
    else if (!headless)
        error_set(
            error,
            "GPU %d gives no OpenGL 4.5 core context; leave the number away to take the first that does",
            gpu);
    return headless;
}

bool headless_use(Headless *headless, bool current)
{
    if (!headless)
        return false;
    const EGLContext context = current ? headless->context : EGL_NO_CONTEXT;
    if (!eglMakeCurrent(headless->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return false;
    if (current)
        gl_context_begin();
    return true;
}

void headless_destroy(Headless *headless)
{
    if (!headless)
        return;
    gl_debug_errors(); /* errors without a debug message */
    eglMakeCurrent(headless->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(headless->display, headless->context);
    eglReleaseThread();
    free(headless);
}

const char *headless_renderer(const Headless *headless)
{
    return headless->renderer;
}

bool offscreen_open(Offscreen *offscreen, const ViewDef *view, const WorldDef *def, const World *world,
                    int width, int height, Error *error)
{
    WorldInfo info;
    *offscreen = (Offscreen){.renderer = renderer_create(view, def, width, height, error),
                             .attributes = renderer_attributes(view)};
    if (!offscreen->renderer || world_shares(world))
        return offscreen->renderer;
    world_info(world, &info);
    offscreen->upload = upload_create(info.capacity, upload_attributes(offscreen->attributes), error);
    return offscreen->upload;
}

void offscreen_close(Offscreen *offscreen)
{
    upload_destroy(offscreen->upload);
    renderer_destroy(offscreen->renderer);
}

/* Gets the world's state for the view. */
static bool take(Offscreen *offscreen, World *world, StageClock *clock, GlTimer *timer,
                 ParticleBuffers *particles, Error *error)
{
    bool ok = true;
    if (world_shares(world))
        GL_STAGE(timer, STAGE_SCALARS)
    world_share(world, offscreen->attributes, particles);
    else STAGE (clock, STAGE_UPLOAD) ok =
        upload_write(offscreen->upload, world, error) && upload_take(offscreen->upload, particles);
    return ok;
}

bool offscreen_draw(Offscreen *offscreen, World *world, StageClock *clock, GlTimer *timer, Error *error)
{
    ParticleBuffers particles;
    const bool ok = take(offscreen, world, clock, timer, &particles, error);
    if (ok)
        renderer_draw(offscreen->renderer, &particles, timer);
    return ok;
}

bool offscreen_count(Offscreen *offscreen, World *world, ViewCounts *counts, Error *error)
{
    ParticleBuffers particles;
    const bool ok = take(offscreen, world, NULL, NULL, &particles, error);
    if (ok)
        renderer_draw_counted(offscreen->renderer, &particles, counts);
    return ok;
}
