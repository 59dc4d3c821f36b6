#define _GNU_SOURCE /* memfd_create, pipe2, F_SETPIPE_SZ */
#include "app/base/file.h"
#include "app/files/pictures.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

enum { LOG_BYTES = 4096 };
enum { PIPE_BYTES = 1 << 20 }; /* large, so that ffmpeg works while the next picture is drawn */

struct Video {
    const PictureFormat *format;
    Output output;
    pid_t process; /* 0: ended */
    int pipe;      /* for writing pictures; -1: closed */
    int log;       /* ffmpeg's messages: a memory file, as a pipe could fill, and a disk could be full */
    size_t bytes;  /* of one picture */
    size_t pictures;
};

/* Uses the colours of BT.709, as expected by players; by default ffmpeg would use the older BT.601.
   fillborders needs planes. */
static void write_filter(char filter[192], int width, int height)
{
    int right = width % 2, bottom = height % 2;
    char odd[96] = "";
    if (right || bottom)
        snprintf(odd, sizeof odd, "format=gbrp,pad=%d:%d,fillborders=right=%d:bottom=%d:mode=smear,",
                 width + right, height + bottom, right, bottom);
    snprintf(filter, 192, "%sscale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd", odd);
}

/* One palette per picture: a common palette would keep all pictures in memory. */
static const char *const as_gif[] = {
    "-filter_complex",
    "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=bayer:bayer_scale=4",
    "-fps_mode",
    "passthrough",
    "-loop",
    "0",
    "-f",
    "gif",
    NULL};
/* H.264, with the index at the file's start. */
static const char *const as_mp4[] = {
    "-c:v",         "libx264",     "-preset",   "veryfast",         "-crf",  "18",         "-pix_fmt",
    "yuv420p",      "-colorspace", "bt709",     "-color_primaries", "bt709", "-color_trc", "bt709",
    "-color_range", "tv",          "-movflags", "+faststart",       "-f",    "mp4",        NULL};

static const PictureFormat png = {.extension = "png", .help = "one picture", .kind = PICTURES_PNG};
static const PictureFormat mp4 = {
    .extension = "mp4", .help = "a video, H.264", .kind = PICTURES_VIDEO, .encoder = as_mp4, .even = true};
static const PictureFormat gif = {.extension = "gif",
                                  .help = "an animation that repeats",
                                  .kind = PICTURES_VIDEO,
                                  .encoder = as_gif,
                                  .fps_max = 50};
static const PictureFormat folder = {
    .extension = "", .help = "frame_00000.png and so on", .kind = PICTURES_FOLDER};

enum { PICTURE_FORMATS_MAX = 8 };

/* Ends with NULL. */
static const PictureFormat *formats[PICTURE_FORMATS_MAX + 1] = {&png, &mp4, &gif, &folder};

const PictureFormat *picture_format_at(int index)
{
    return formats[index];
}

void picture_format_add(const PictureFormat *format)
{
    int count = 0;
    while (formats[count])
        count++;
    assert(count < PICTURE_FORMATS_MAX);
    formats[count] = format;
}

/* Finds the format: by the extension of the name, or a folder: no extension, or a final slash. Returns NULL
   for other extensions. */
static const PictureFormat *picture_format_find(const char *path, Error *error)
{
    char known[128] = "";
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    if (path[0] && (!dot || dot == name || strcmp(name, "..") == 0))
        return &folder;
    for (int i = 0; formats[i]; i++) {
        if (formats[i] == &folder)
            continue;
        if (dot && strcasecmp(dot + 1, formats[i]->extension) == 0)
            return formats[i];
        snprintf(known + strlen(known), sizeof known - strlen(known), "%s.%s", *known ? ", " : "",
                 formats[i]->extension);
    }
    error_set(error, "cannot tell the format from '%s'; use %s or a folder name", path, known);
    return NULL;
}

bool pictures_kind(const char *path, PicturesKind *kind, Error *error)
{
    const PictureFormat *format = picture_format_find(path, error);
    if (format)
        *kind = format->kind;
    return format != NULL;
}

enum { ARGUMENTS_MAX = 48 };

static void add_all(char *arguments[ARGUMENTS_MAX], const char *const more[])
{
    int count = 0;
    while (arguments[count])
        count++;
    for (int i = 0; more[i]; i++)
        arguments[count++] = (char *)more[i];
}

/* Starts ffmpeg, without messages on the terminal. Returns 0 or the system's error number. */
static int spawn_ffmpeg(Video *video, int input, int width, int height, double fps)
{
    char size[32], rate[32], filter[192];
    snprintf(size, sizeof size, "%dx%d", width, height);
    snprintf(rate, sizeof rate, "%.6f", fps);
    write_filter(filter, width, height);
    char *arguments[ARGUMENTS_MAX] = {
        "ffmpeg",   "-nostdin", "-hide_banner", "-v", "error",      "-xerror", "-y", "-f",    "rawvideo",
        "-pix_fmt", "rgb24",    "-video_size",  size, "-framerate", rate,      "-i", "pipe:0"};
    if (video->format->even)
        add_all(arguments, (const char *const[]){"-vf", filter, NULL});
    add_all(arguments, video->format->encoder);
    add_all(arguments, (const char *const[]){video->output.temp, NULL});
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, video->log, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, video->log, STDERR_FILENO);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setpgroup(&attributes, 0); /* Ctrl-C in the terminal must not reach ffmpeg */
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    int reason = posix_spawnp(&video->process, "ffmpeg", &actions, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return reason;
}

static bool start(Video *video, int width, int height, double fps, Error *error)
{
    int ends[2];
    video->log = memfd_create("ffmpeg", MFD_CLOEXEC);
    if (video->log < 0 || pipe2(ends, O_CLOEXEC) != 0)
        return error_set(error, "%s: cannot start ffmpeg: %s", video->output.path, strerror(errno));
    fcntl(ends[1], F_SETPIPE_SZ, PIPE_BYTES);
    int reason = spawn_ffmpeg(video, ends[0], width, height, fps);
    close(ends[0]);
    video->pipe = ends[1];
    if (reason == 0)
        return true;
    video->process = 0;
    if (reason == ENOENT)
        return error_set(error,
                         "%s: a video needs the program ffmpeg, which was not found; install the package "
                         "ffmpeg, or render a folder of frames (-o DIR)",
                         video->output.path);
    return error_set(error, "%s: cannot start ffmpeg: %s", video->output.path, strerror(reason));
}

static bool choose_format(Video *video, const char *path, double fps, Error *error)
{
    const PictureFormat *format = video->format = picture_format_find(path, error);
    if (!format)
        return false;
    if (format->kind != PICTURES_VIDEO)
        return error_set(error, "%s: not the name of a video; use an .mp4", path);
    return format->fps_max == 0 || fps <= format->fps_max ||
           error_set(error, "%s: a .%s has at most %g pictures a second, not %g; use --fps 25, or an .mp4",
                     path, format->extension, format->fps_max, fps);
}

Video *video_create(const char *path, int width, int height, double fps, Error *error)
{
    Video *video = calloc(1, sizeof *video);
    if (!video) {
        error_set(error, "%s: out of memory", path);
        return NULL;
    }
    video->pipe = video->log = -1;
    video->bytes = 3 * (size_t)width * (size_t)height;
    if (choose_format(video, path, fps, error) && output_begin(&video->output, path, error) &&
        start(video, width, height, fps, error))
        return video;
    video_discard(video);
    return NULL;
}

/* The last line of ffmpeg's messages, in `log`; empty if there are none. */
static char *last_line(const Video *video, char log[LOG_BYTES])
{
    off_t size = lseek(video->log, 0, SEEK_END);
    off_t from = size >= LOG_BYTES ? size - LOG_BYTES + 1 : 0;
    ssize_t length = pread(video->log, log, LOG_BYTES - 1, from);
    log[length > 0 ? length : 0] = '\0';
    while (length > 0 && strchr("\r\n ", log[length - 1]))
        log[--length] = '\0';
    char *newline = strrchr(log, '\n');
    return newline ? newline + 1 : log;
}

/* Sets the error, with the temporary name replaced by the path. */
static bool fail_with_words(const Video *video, const char *words, Error *error)
{
    const char *path = video->output.path;
    const char *temp = strstr(words, video->output.temp);
    if (!temp)
        return error_set(error, "%s: ffmpeg could not write the video: %s", path, words);
    return error_set(error, "%s: ffmpeg could not write the video: %.*s%s%s", path, (int)(temp - words),
                     words, path, temp + strlen(video->output.temp));
}

/* Closes the pipe and waits; returns the exit status as from waitpid. */
static int wait_for_end(Video *video)
{
    int status = 0;
    if (video->pipe >= 0)
        close(video->pipe);
    video->pipe = -1;
    while (video->process && waitpid(video->process, &status, 0) < 0 && errno == EINTR)
        ;
    video->process = 0;
    return status;
}

static bool fail_with_last_line(const Video *video, int status, Error *error)
{
    char log[LOG_BYTES];
    const char *line = last_line(video, log);
    if (line[0])
        return fail_with_words(video, line, error);
    if (WIFSIGNALED(status))
        return error_set(error, "%s: ffmpeg was ended by signal %d (%s)", video->output.path,
                         WTERMSIG(status), strsignal(WTERMSIG(status)));
    return error_set(error, "%s: ffmpeg ended early, with exit code %d", video->output.path,
                     WEXITSTATUS(status));
}

bool video_add(Video *video, const uint8_t *rgb, Error *error)
{
    size_t done = 0;
    while (video->pipe >= 0 && done < video->bytes) {
        ssize_t written = write(video->pipe, rgb + done, video->bytes - done);
        if (written > 0)
            done += (size_t)written;
        else if (errno != EINTR)
            break;
    }
    if (done < video->bytes)
        return fail_with_last_line(video, wait_for_end(video), error);
    video->pictures++;
    return true;
}

bool video_finish(Video *video, Error *error)
{
    bool whole = false;
    if (video->pictures == 0) {
        error_set(error, "%s: no picture was made, so there is no video", video->output.path);
    } else {
        const int status = wait_for_end(video);
        struct stat is;
        if (status != 0)
            fail_with_last_line(video, status, error);
        else if (stat(video->output.temp, &is) != 0 || is.st_size == 0)
            error_set(error, "%s: ffmpeg has written nothing", video->output.path);
        else
            whole = output_commit(&video->output, error);
    }
    video_discard(video);
    return whole;
}

void video_discard(Video *video)
{
    if (!video)
        return;
    if (video->process)
        kill(video->process, SIGKILL);
    wait_for_end(video);
    if (video->log >= 0)
        close(video->log);
    output_discard(&video->output);
    free(video);
}

void dated_file_name(char path[1024], const char *extension)
{
    char stamp[32];
    const time_t now = time(NULL);
    struct tm local;
    strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", localtime_r(&now, &local));
    snprintf(path, 1024, "slosh-%s.%s", stamp, extension);
    for (int i = 2; access(path, F_OK) == 0 && i < 1000; i++)
        snprintf(path, 1024, "slosh-%s-%d.%s", stamp, i, extension);
}

struct Pictures {
    PicturesKind kind;
    char path[1024];
    Video *video;
    Output png;
    const ImageText *text; /* NULL: none */
    size_t count, of;      /* written; to come, 0: not known */
    bool made_folder;
};

static void frame_path(const Pictures *pictures, size_t index, char path[1088])
{
    size_t length = strlen(pictures->path);
    const char *slash = length && pictures->path[length - 1] == '/' ? "" : "/";
    snprintf(path, 1088, "%s%sframe_%0*zu.png", pictures->path, slash, number_digits(pictures->of, 5), index);
}

/* Makes the folder, and checks that a file can be written there. */
static bool begin_folder(Pictures *pictures, Error *error)
{
    char frame[1088];
    struct stat status;
    if (mkdir(pictures->path, 0777) == 0)
        pictures->made_folder = true;
    else if (errno != EEXIST)
        return error_set(error, "%s: the folder cannot be created: %s", pictures->path, strerror(errno));
    else if (stat(pictures->path, &status) == 0 && !S_ISDIR(status.st_mode))
        return error_set(error, "%s: is a file, not a folder; name a FILE.png, a FILE.mp4 or a folder",
                         pictures->path);
    frame_path(pictures, 0, frame);
    return output_check(frame, error);
}

static bool begin(Pictures *pictures, int width, int height, double fps, Error *error)
{
    if (strlen(pictures->path) + 1 == sizeof pictures->path)
        return error_set(error, "the name of the output is too long; name a shorter one");
    if (!pictures_kind(pictures->path, &pictures->kind, error))
        return false;
    if (pictures->kind == PICTURES_PNG)
        return output_begin(&pictures->png, pictures->path, error);
    if (pictures->kind == PICTURES_FOLDER)
        return begin_folder(pictures, error);
    pictures->video = video_create(pictures->path, width, height, fps, error);
    return pictures->video != NULL;
}

Pictures *pictures_create(const char *path, int width, int height, double fps, size_t count, Error *error)
{
    Pictures *pictures = calloc(1, sizeof *pictures);
    if (!pictures) {
        error_set(error, "%s: out of memory", path);
        return NULL;
    }
    snprintf(pictures->path, sizeof pictures->path, "%s", path);
    pictures->of = count;
    if (begin(pictures, width, height, fps, error))
        return pictures;
    pictures_discard(pictures);
    return NULL;
}

static bool write_png(const Output *output, const Image *image, const ImageText *text, Error *error)
{
    FILE *file = fopen(output->temp, "wb");
    if (!file)
        return error_set(error, "%s: cannot write the picture: %s", output->path, strerror(errno));
    bool written = image_write_stream(image, text, file, output->path, error);
    if (fclose(file) != 0 && written)
        written = error_set(error, "%s: cannot write the picture: %s", output->path, strerror(errno));
    return written;
}

static bool add_frame(const Pictures *pictures, const Image *image, Error *error)
{
    char path[1088];
    Output output = {0};
    frame_path(pictures, pictures->count, path);
    if (!output_begin(&output, path, error))
        return false;
    if (write_png(&output, image, pictures->text, error))
        return output_commit(&output, error);
    output_discard(&output);
    return false;
}

void pictures_embed(Pictures *pictures, const ImageText *text)
{
    pictures->text = text;
}

bool pictures_add(Pictures *pictures, const Image *image, Error *error)
{
    bool added = pictures->kind == PICTURES_PNG     ? write_png(&pictures->png, image, pictures->text, error)
                 : pictures->kind == PICTURES_VIDEO ? video_add(pictures->video, image->rgb, error)
                                                    : add_frame(pictures, image, error);
    pictures->count += added;
    return added;
}

bool pictures_find_stale(const Pictures *pictures, char frame[1088])
{
    frame_path(pictures, pictures->count, frame);
    return pictures->kind == PICTURES_FOLDER && access(frame, F_OK) == 0;
}

bool pictures_finish(Pictures *pictures, Error *error)
{
    bool finished = true;
    if (pictures->kind == PICTURES_VIDEO) {
        finished = video_finish(pictures->video, error);
        pictures->video = NULL;
    } else if (pictures->kind == PICTURES_PNG) {
        finished = pictures->count > 0 ? output_commit(&pictures->png, error)
                                       : error_set(error, "%s: no picture was made", pictures->path);
    }
    pictures_discard(pictures);
    return finished;
}

size_t pictures_kept(const Pictures *pictures)
{
    return pictures && pictures->kind == PICTURES_FOLDER ? pictures->count : 0;
}

void pictures_discard(Pictures *pictures)
{
    if (!pictures)
        return;
    video_discard(pictures->video);
    output_discard(&pictures->png);
    if (pictures->made_folder && pictures->count == 0)
        rmdir(pictures->path);
    free(pictures);
}
