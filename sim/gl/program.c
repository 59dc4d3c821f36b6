#include "sim/gl/program.h"

#include "sim/gl/shader_source.h"

#include <epoxy/gl.h>
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

static bool compile(GLuint shader, const ShaderSource *source, Error *error)
{
    GLint done = GL_FALSE;
    glShaderSource(shader, 1, (const GLchar *const *)&source->text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done)
        return true;
    char log[LOG_MAX], named[LOG_MAX];
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    shader_source_log(source, log, named, sizeof named);
    return error_set(error, "%s", named);
}

static bool attach(GLuint program, const char *path, const char *defines, Error *error)
{
    GLenum kind = stage_kind(path);
    if (!kind)
        return error_set(error, "%s: unknown kind of shader; .vert, .geom, .frag and .comp are known", path);
    ShaderSource source;
    GLuint shader = glCreateShader(kind);
    bool done = shader_source_load(&source, path, defines, error) && compile(shader, &source, error);
    shader_source_free(&source);
    if (done)
        glAttachShader(program, shader);
    glObjectLabel(GL_SHADER, shader, -1, path);
    glDeleteShader(shader); /* lives on as long as the program */
    return done;
}

static bool link_program(GLuint program, const char *label, Error *error)
{
    GLint done = GL_FALSE;
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    if (done)
        return true;
    char log[LOG_MAX];
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    return error_set(error, "%s: the program does not link: %s", label, log);
}

unsigned program_create(const char *label, const char *const stages[], const char *defines, Error *error)
{
    GLuint program = glCreateProgram();
    glObjectLabel(GL_PROGRAM, program, -1, label);
    bool done = true;
    for (int i = 0; done && stages[i]; i++)
        done = attach(program, stages[i], defines, error);
    if (done && link_program(program, label, error))
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
