#include "sim/gl/program.h"

#include "sim/gl/shader_source.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <string.h>

enum { LOG_MAX = 4096 };

static GLenum stage_kind(const char *path)
{
    static const struct {
        const char *ending;
        GLenum kind;
    } kinds[] = {{".vert", GL_VERTEX_SHADER},
                 {".geom", GL_GEOMETRY_SHADER},
                 {".frag", GL_FRAGMENT_SHADER},
                 {".comp", GL_COMPUTE_SHADER}};
    const char *ending = strrchr(path, '.');
    for (size_t i = 0; ending && i < sizeof kinds / sizeof kinds[0]; i++)
        if (strcmp(ending, kinds[i].ending) == 0)
            return kinds[i].kind;
    return 0;
}

static bool attach(GLuint program, const char *path, const char *defines, Error *error)
{
    GLenum kind = stage_kind(path);
    if (!kind)
        return error_set(error, "%s: unknown kind of shader; .vert, .geom, .frag and .comp are known", path);
    ShaderSource source;
    const GLuint shader = glCreateShader(kind);
    const bool done = shader_source_load(&source, path, defines, error);
    if (done) {
        glShaderSource(shader, 1, (const GLchar *const *)&source.text, NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
    }
    shader_source_free(&source);
    glObjectLabel(GL_SHADER, shader, -1, path);
    glDeleteShader(shader); /* lives as long as the program */
    return done;
}

unsigned program_begin(const char *label, const char *const stages[], const char *defines, Error *error)
{
    GLuint program = glCreateProgram();
    glObjectLabel(GL_PROGRAM, program, -1, label);
    bool done = true;
    for (int i = 0; done && stages[i]; i++)
        done = attach(program, stages[i], defines, error);
    if (done) {
        glLinkProgram(program);
        return program;
    }
    glDeleteProgram(program);
    return 0;
}

/* Reports a log with file names, reading the files again. */
static bool say_log(const char *log, const char *label, const char *path, const char *defines, Error *error)
{
    char named[LOG_MAX];
    ShaderSource source;
    if (!shader_source_load(&source, path, defines, error))
        return false;
    const bool placed = shader_source_log(&source, log, named, sizeof named);
    shader_source_free(&source);
    return error_set(error, "%s%s%s%s", label, placed ? "" : path, placed ? "" : ": ", named);
}

static bool compiled(GLuint program, const char *const stages[], const char *defines, Error *error)
{
    enum { STAGES_MOST = 3 };
    GLuint shaders[STAGES_MOST];
    GLsizei count = 0;
    bool done = true;
    glGetAttachedShaders(program, STAGES_MOST, &count, shaders);
    for (int i = 0; done && i < count; i++) {
        GLint good = GL_FALSE, kind = 0;
        glGetShaderiv(shaders[i], GL_COMPILE_STATUS, &good);
        glGetShaderiv(shaders[i], GL_SHADER_TYPE, &kind);
        for (int k = 0; !good && done && stages[k]; k++)
            if (stage_kind(stages[k]) == (GLenum)kind) {
                char log[LOG_MAX];
                glGetShaderInfoLog(shaders[i], sizeof log, NULL, log);
                done = say_log(log, "", stages[k], defines, error);
            }
    }
    return done;
}

bool program_finish(unsigned program, const char *label, const char *const stages[], const char *defines,
                    Error *error)
{
    GLint done = GL_FALSE;
    if (!compiled(program, stages, defines, error))
        return false;
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    if (done)
        return true;
    char log[LOG_MAX], before[160];
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    snprintf(before, sizeof before, "%s: the program does not link: ", label);
    if (!stages[1]) /* line numbers refer to the only stage */
        return say_log(log, before, stages[0], defines, error);
    return error_set(error, "%s%s", before, log);
}

unsigned program_create(const char *label, const char *const stages[], const char *defines, Error *error)
{
    const GLuint program = program_begin(label, stages, defines, error);
    if (!program || program_finish(program, label, stages, defines, error))
        return program;
    glDeleteProgram(program);
    return 0;
}

unsigned program_create_pair(const char *label, const char *vertex, const char *fragment, Error *error)
{
    return program_create(label, (const char *const[]){vertex, fragment, NULL}, NULL, error);
}

void program_set_directory(const char *directory)
{
    shader_source_set_directory(directory);
}
