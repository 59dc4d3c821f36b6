#include "sim/gpu/gl.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static char shader_directory[1024];

void shader_source_set_directory(const char *directory)
{
    snprintf(shader_directory, sizeof shader_directory, "%s", directory ? directory : "");
}

static bool append(ShaderSource *source, const char *text, size_t size)
{
    if (source->size + size + 1 > source->capacity) {
        size_t capacity = 2 * (source->size + size + 1);
        char *grown = realloc(source->text, capacity);
        if (!grown)
            return false;
        source->text = grown;
        source->capacity = capacity;
    }
    memcpy(source->text + source->size, text, size);
    source->size += size;
    source->text[source->size] = 0;
    return true;
}

/* The line number also encodes the file: Mesa 22 drops the file's number in some messages. */
enum { LINES_MAX = 100000 };

static bool append_line_mark(ShaderSource *source, int line, int file)
{
    char mark[64];
    int size = snprintf(mark, sizeof mark, "#line %d %d\n", file * LINES_MAX + line, file);
    return append(source, mark, (size_t)size);
}

static const EmbeddedShader *embedded(const char *path)
{
    const EmbeddedShader *shader = embedded_shaders;
    while (shader->path && strcmp(shader->path, path) != 0)
        shader++;
    return shader->path ? shader : NULL;
}

static char *read_embedded(const char *path)
{
    const EmbeddedShader *shader = embedded(path);
    return shader ? strdup(shader->text) : NULL;
}

static char *read_stream(FILE *file)
{
    enum { SHADER_BYTES_MAX = 1 << 20 };
    char *text = malloc(SHADER_BYTES_MAX + 1);
    if (!text)
        return NULL;
    size_t size = fread(text, 1, SHADER_BYTES_MAX, file);
    text[size] = 0;
    return text;
}

enum { NAME_MAX_SIZE = sizeof shader_directory + SHADER_PATH_MAX + 2 };

static void name_in_directory(const char *path, char name[NAME_MAX_SIZE])
{
    snprintf(name, NAME_MAX_SIZE, "%s/%s", shader_directory, path);
}

uint64_t shader_source_stamp(void)
{
    uint64_t stamp = 0;
    for (const EmbeddedShader *shader = embedded_shaders; shader_directory[0] && shader->path; shader++) {
        char name[NAME_MAX_SIZE];
        struct stat status;
        name_in_directory(shader->path, name);
        if (stat(name, &status) == 0)
            stamp = stamp * 31 + (uint64_t)status.st_mtim.tv_sec * 1000000007U +
                    (uint64_t)status.st_mtim.tv_nsec + 1;
    }
    return stamp;
}

bool shader_source_has(const char *path)
{
    char name[NAME_MAX_SIZE];
    struct stat status;
    name_in_directory(path, name);
    return *shader_directory ? stat(name, &status) == 0 : embedded(path) != NULL;
}

static char *read_from_directory(const char *path)
{
    char name[NAME_MAX_SIZE];
    name_in_directory(path, name);
    FILE *file = fopen(name, "rb");
    if (!file)
        return NULL;
    char *text = read_stream(file);
    fclose(file);
    return text;
}

static bool already_has(const ShaderSource *source, const char *path)
{
    for (int i = 0; i < source->file_count; i++)
        if (strcmp(source->file[i], path) == 0)
            return true;
    return false;
}

static bool append_file(ShaderSource *source, const char *path, const char *from, Error *error);

/* After these lines a compiler that skipped lines, including marks, has a wrong line number. */
static bool ends_group(const char *line)
{
    line += strspn(line, " \t");
    return strncmp(line, "#endif", 6) == 0 || strncmp(line, "#el", 3) == 0;
}

/* Headers shared with C have paths from the root of the tree, as in C. */
static const char *below_shaders(const char *path)
{
    static const char folder[] = "shaders/";
    return path + (strncmp(path, folder, sizeof folder - 1) == 0 ? sizeof folder - 1 : 0);
}

/* The path for `#include NAME`, from an earlier line `#define NAME path`; empty if there is no such line. */
static bool named_path(const ShaderSource *source, const char *line, char path[SHADER_PATH_MAX])
{
    char name[SHADER_PATH_MAX], wanted[SHADER_PATH_MAX + 16];
    path[0] = 0;
    if (sscanf(line, " #include %127[A-Z_]", name) != 1)
        return false;
    snprintf(wanted, sizeof wanted, "\n#define %s ", name);
    const char *found = strstr(source->text, wanted);
    if (found)
        sscanf(found + strlen(wanted), "%127s", path);
    return true;
}

/* Copies a line, or pastes an included file. */
static bool append_source_line(ShaderSource *source, const char *line, size_t size, int file, int number,
                               Error *error)
{
    char path[SHADER_PATH_MAX], from[SHADER_PATH_MAX + 16], copy[SHADER_PATH_MAX + 16];
    snprintf(copy, sizeof copy, "%.*s", (int)size, line);
    if (named_path(source, copy, path) && !path[0])
        return append(source, "\n", 1) || error_set(error, "out of memory for shaders");
    if (!path[0] && sscanf(copy, " #include \"%127[^\"]\"", path) != 1)
        return (append(source, line, size) && (line[size - 1] != '\n' || !ends_group(copy) ||
                                               append_line_mark(source, number + 1, file))) ||
               error_set(error, "out of memory for shaders");
    snprintf(from, sizeof from, "%s:%d: ", source->file[file], number);
    return append_file(source, below_shaders(path), from, error) &&
           (append_line_mark(source, number + 1, file) || error_set(error, "out of memory for shaders"));
}

static bool append_text(ShaderSource *source, const char *text, int file, Error *error)
{
    int number = 1;
    for (const char *line = text; *line; number++) {
        const char *end = strchr(line, '\n');
        size_t size = end ? (size_t)(end - line) + 1 : strlen(line);
        if (!append_source_line(source, line, size, file, number, error))
            return false;
        line += size;
    }
    return append(source, "\n", 1) || error_set(error, "out of memory for shaders");
}

static bool append_file(ShaderSource *source, const char *path, const char *from, Error *error)
{
    if (already_has(source, path))
        return true;
    if (source->file_count == SHADER_FILES_MAX)
        return error_set(error, "%stoo many includes; at most %d files a shader", from, SHADER_FILES_MAX);
    char *text = *shader_directory ? read_from_directory(path) : read_embedded(path);
    if (!text)
        return error_set(error, "%sthere is no shader \"%s\" in %s; paths count from shaders/", from, path,
                         *shader_directory ? shader_directory : "the program");
    int file = source->file_count++;
    snprintf(source->file[file], SHADER_PATH_MAX, "%s", path);
    bool done = append_line_mark(source, 1, file) ? append_text(source, text, file, error)
                                                  : error_set(error, "out of memory for shaders");
    free(text);
    return done;
}

static bool ends_in(const char *path, const char *ending)
{
    const char *dot = strrchr(path, '.');
    return dot && strcmp(dot, ending) == 0;
}

/* The backend fragment uses GLSL 3.30, checked by the compiler. */
static const char *version_of(const char *path)
{
    const bool drawn = ends_in(path, ".vert") || ends_in(path, ".geom") || ends_in(path, ".frag");
    return drawn && strncmp(path, "sim/", 4) == 0 ? "#version 330 core\n" : "#version 450 core\n";
}

bool shader_source_load(ShaderSource *source, const char *path, const char *defines, Error *error)
{
    const char *version = version_of(path);
    *source = (ShaderSource){0};
    const bool begun =
        append(source, version, strlen(version)) && (!defines || append(source, defines, strlen(defines)));
    const bool loaded =
        begun ? append_file(source, path, "", error) : error_set(error, "out of memory for shaders");
    if (!loaded)
        shader_source_free(source);
    return loaded;
}

void shader_source_free(ShaderSource *source)
{
    free(source->text);
    *source = (ShaderSource){0};
}

/* Parses "1:12(5): error" of Mesa, "1(12) : error" of NVIDIA, "ERROR: 1:12: " of further drivers. Returns
   the length of the place, or 0 if there is none. */
static int parse_place(const char *text, int *file, int *line)
{
    int length = 0, column;
    if (sscanf(text, "%d:%d(%d):%n", file, line, &column, &length) == 3 && length)
        return length;
    if (sscanf(text, "%d(%d) :%n", file, line, &length) == 2 && length)
        return length;
    if (sscanf(text, "ERROR: %d:%d:%n", file, line, &length) == 2 && length)
        return length;
    return 0;
}

/* Copies the compiler's log with "file:line:" instead of numbers. True if the log has such a place: some
   logs have none for errors at a text's end. */
static bool shader_source_log(const ShaderSource *source, const char *log, char *out, size_t out_size)
{
    size_t used = 0;
    bool placed = false;
    out[0] = 0;
    while (*log && used + 1 < out_size) {
        int file = -1, line = 0, place = parse_place(log, &file, &line);
        size_t rest = strcspn(log + place, "\n");
        file = line / LINES_MAX;
        if (place && file >= 0 && file < source->file_count) {
            used +=
                (size_t)snprintf(out + used, out_size - used, "%s:%d:", source->file[file], line % LINES_MAX);
            placed = true;
        } else {
            place = 0, rest = strcspn(log, "\n");
        }
        if (used < out_size)
            used += (size_t)snprintf(out + used, out_size - used, "%.*s", (int)rest, log + place);
        log += (size_t)place + rest;
        if (*log == '\n' && *++log && used + 1 < out_size)
            out[used++] = '\n', out[used] = 0;
    }
    return placed;
}

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

enum { STAGES_MOST = 3 };

/* Sources of a program. */
typedef struct ProgramSource {
    int count;
    const char *const *paths;
    ShaderSource stages[STAGES_MOST];
    const char *captured; /* output for transform feedback; NULL: none */
    uint64_t hash;
} ProgramSource;

/* FNV-1a, 64 bits. */
static void hash_text(uint64_t *hash, const char *text)
{
    const size_t size = text ? strlen(text) + 1 : 0;
    for (size_t i = 0; i < size; i++)
        *hash = (*hash ^ (unsigned char)text[i]) * UINT64_C(0x100000001B3);
}

static void sources_free(ProgramSource *source)
{
    for (int i = 0; i < STAGES_MOST; i++)
        shader_source_free(&source->stages[i]);
}

/* Free in either case. */
static bool sources_load(ProgramSource *source, const char *const stages[], const char *defines,
                         const char *captured, Error *error)
{
    *source = (ProgramSource){.paths = stages, .captured = captured, .hash = UINT64_C(0xCBF29CE484222325)};
    for (int i = 0; i < STAGES_MOST && stages[i]; i++) {
        ShaderSource stage;
        if (!stage_kind(stages[i]))
            return error_set(error, "%s: unknown kind of shader; .vert, .geom, .frag and .comp are known",
                             stages[i]);
        if (!shader_source_load(&stage, stages[i], defines, error))
            return false;
        hash_text(&source->hash, stages[i]);
        hash_text(&source->hash, stage.text);
        source->stages[source->count++] = stage;
    }
    hash_text(&source->hash, captured ? captured : "");
    return true;
}

/* Linked programs of the process, by hash of the sources: a second panel compiles nothing. Each owner has a
   separate program, for separate uniforms. */
typedef struct LinkedProgram {
    uint64_t hash;
    GLuint program; /* being compiled; 0: `binary` is known */
    GLenum format;
    GLsizei size;
    void *binary;
} LinkedProgram;

static struct {
    LinkedProgram *of;
    size_t count, capacity;
} linked;

static LinkedProgram *linked_find(uint64_t hash)
{
    for (size_t i = 0; i < linked.count; i++)
        if (linked.of[i].hash == hash)
            return &linked.of[i];
    return NULL;
}

/* Without memory, later programs compile. */
static void linked_expect(uint64_t hash, GLuint program)
{
    LinkedProgram *row = linked_find(hash);
    free(row ? row->binary : NULL); /* refused by the driver */
    if (!row && linked.count == linked.capacity) {
        const size_t more = 2 * linked.capacity + 64;
        LinkedProgram *grown = realloc(linked.of, more * sizeof *grown);
        if (!grown)
            return;
        linked.of = grown;
        linked.capacity = more;
    }
    row = row ? row : &linked.of[linked.count++];
    for (size_t i = 0; i < linked.count; i++) /* a deleted program may have had the name */
        linked.of[i].program = linked.of[i].program == program ? 0 : linked.of[i].program;
    *row = (LinkedProgram){.hash = hash, .program = program};
}

/* Keeps the binary of an awaited program. */
static void linked_keep(GLuint program)
{
    GLint size = 0;
    for (size_t i = 0; i < linked.count; i++) {
        LinkedProgram *row = &linked.of[i];
        if (row->program != program)
            continue;
        row->program = 0;
        glGetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &size);
        row->binary = size > 0 ? malloc((size_t)size) : NULL;
        if (row->binary)
            glGetProgramBinary(program, size, &row->size, &row->format, row->binary);
    }
}

/* Returns 0 without a binary, or if the driver refuses the binary. */
static GLuint linked_take(uint64_t hash, const char *label)
{
    const LinkedProgram *row = linked_find(hash);
    GLint done = GL_FALSE;
    if (!row || !row->binary)
        return 0;
    const GLuint program = glCreateProgram();
    glObjectLabel(GL_PROGRAM, program, -1, label);
    glProgramBinary(program, row->format, row->binary, row->size);
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    if (done)
        return program;
    glDeleteProgram(program);
    return 0;
}

static void attach(GLuint program, const char *path, const ShaderSource *source)
{
    const GLuint shader = glCreateShader(stage_kind(path));
    glShaderSource(shader, 1, (const GLchar *const *)&source->text, NULL);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glObjectLabel(GL_SHADER, shader, -1, path);
    glDeleteShader(shader); /* lives as long as the program */
}

static GLuint compile(const ProgramSource *source, const char *label)
{
    const GLuint program = glCreateProgram();
    glObjectLabel(GL_PROGRAM, program, -1, label);
    for (int i = 0; i < source->count; i++)
        attach(program, source->paths[i], &source->stages[i]);
    if (source->captured)
        glTransformFeedbackVaryings(program, 1, &source->captured, GL_INTERLEAVED_ATTRIBS);
    glProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glLinkProgram(program);
    linked_expect(source->hash, program);
    return program;
}

static GLuint begin(const char *label, const char *const stages[], const char *defines, const char *captured,
                    Error *error)
{
    ProgramSource source;
    GLuint program = 0;
    if (sources_load(&source, stages, defines, captured, error)) {
        program = linked_take(source.hash, label);
        program = program ? program : compile(&source, label);
    }
    sources_free(&source);
    return program;
}

unsigned program_begin(const char *label, const char *const stages[], const char *defines, Error *error)
{
    return begin(label, stages, defines, NULL, error);
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
    if (done) {
        linked_keep(program);
        return true;
    }
    char log[LOG_MAX], before[160];
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    snprintf(before, sizeof before, "%s: the program does not link: ", label);
    if (!stages[1]) /* line numbers refer to the only stage */
        return say_log(log, before, stages[0], defines, error);
    return error_set(error, "%s%s", before, log);
}

/* ---- several at a time ---- */

typedef struct PendingProgram {
    GLuint program;
    char label[64], *defines;
    const char *stages[STAGES_MOST + 1]; /* owned */
} PendingProgram;

static struct {
    int depth; /* of programs_begin */
    PendingProgram *of;
    size_t count, capacity;
} pending;

static void pending_free(PendingProgram *one)
{
    free(one->defines);
    for (int i = 0; one->stages[i]; i++)
        free((char *)one->stages[i]);
}

/* Returns false if memory is short. */
static bool pending_add(GLuint program, const char *label, const char *const stages[], const char *defines)
{
    if (pending.count == pending.capacity) {
        const size_t more = 2 * pending.capacity + 32;
        PendingProgram *grown = realloc(pending.of, more * sizeof *grown);
        if (!grown)
            return false;
        pending.of = grown;
        pending.capacity = more;
    }
    PendingProgram one = {.program = program, .defines = defines ? strdup(defines) : NULL};
    bool copied = !defines || one.defines;
    snprintf(one.label, sizeof one.label, "%s", label);
    for (int i = 0; copied && stages[i]; i++)
        copied = (one.stages[i] = strdup(stages[i])) != NULL;
    if (copied)
        pending.of[pending.count++] = one;
    else
        pending_free(&one);
    return copied;
}

void programs_begin(void)
{
    pending.depth++;
}

bool programs_finish(Error *error)
{
    bool done = true;
    if (--pending.depth > 0)
        return true;
    for (size_t i = 0; i < pending.count; i++) {
        PendingProgram *one = &pending.of[i];
        if (done && glIsProgram(one->program)) /* a failed owner has deleted the programs */
            done = program_finish(one->program, one->label, one->stages, one->defines, error);
        pending_free(one);
    }
    pending.count = 0;
    return done;
}

/* Finishes a program, at once or with others. */
static GLuint finish(GLuint program, const char *label, const char *const stages[], const char *defines,
                     Error *error)
{
    if (!program || (pending.depth > 0 && pending_add(program, label, stages, defines)) ||
        program_finish(program, label, stages, defines, error))
        return program;
    glDeleteProgram(program);
    return 0;
}

unsigned program_create(const char *label, const char *const stages[], const char *defines, Error *error)
{
    return finish(program_begin(label, stages, defines, error), label, stages, defines, error);
}

unsigned program_create_captured(const char *label, const char *const stages[], const char *defines,
                                 const char *output, Error *error)
{
    return finish(begin(label, stages, defines, output, error), label, stages, defines, error);
}

unsigned program_create_pair(const char *label, const char *vertex, const char *fragment, Error *error)
{
    return program_create(label, (const char *const[]){vertex, fragment, NULL}, NULL, error);
}

void program_set_directory(const char *directory)
{
    shader_source_set_directory(directory);
}
