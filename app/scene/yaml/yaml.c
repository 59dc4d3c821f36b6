#include "app/scene/yaml/yaml.h"

#include <assert.h>
#include <libfyaml.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct YamlBlock YamlBlock;
struct YamlBlock {
    YamlBlock *next;
    size_t used;
    _Alignas(16) char bytes[];
};

enum { BLOCK_BYTES = 16384 };

void *tree_alloc(YamlTree *tree, size_t size)
{
    size = (size + 15) & ~(size_t)15;
    YamlBlock *block = tree->blocks;
    if (!block || size > BLOCK_BYTES - block->used) {
        const size_t capacity = size > BLOCK_BYTES ? size : BLOCK_BYTES;
        block = calloc(1, sizeof *block + capacity);
        if (!block)
            return NULL;
        block->next = tree->blocks;
        tree->blocks = block;
    }
    void *bytes = block->bytes + block->used;
    /* A large allocation's own block counts as full. */
    block->used = size > BLOCK_BYTES ? BLOCK_BYTES : block->used + size;
    return bytes;
}

void tree_free(YamlTree *tree)
{
    while (tree->blocks) {
        YamlBlock *next = tree->blocks->next;
        free(tree->blocks);
        tree->blocks = next;
    }
    tree->root = NULL;
}

const YamlNode *node_child(const YamlNode *mapping, const char *key)
{
    for (const YamlNode *node = mapping->first; node; node = node->next)
        if (node->key && strcmp(node->key, key) == 0)
            return node;
    return NULL;
}

const YamlNode *node_element(const YamlNode *sequence, size_t index)
{
    const YamlNode *node = sequence->first;
    while (node && index--)
        node = node->next;
    return node;
}

size_t node_count(const YamlNode *node)
{
    size_t count = 0;
    for (const YamlNode *child = node->first; child; child = child->next)
        count++;
    return count;
}

bool path_next(const char **path, YamlPathPart *part)
{
    const char *at = *path;
    part->index = -1;
    if (*at == '[') {
        char *end;
        if (at[1] < '0' || at[1] > '9')
            return false;
        part->index = strtol(at + 1, &end, 10);
        if (*end != ']' || part->index > 1000000)
            return false;
        *path = end[1] == '.' ? end + 2 : end + 1;
        return end[1] == '.' ? end[2] : !end[1] || end[1] == '[';
    }
    const size_t length = strcspn(at, ".[");
    if (length == 0 || length >= sizeof part->key)
        return false;
    memcpy(part->key, at, length);
    part->key[length] = 0;
    *path = at[length] == '.' ? at + length + 1 : at + length;
    return at[length] != '.' || **path;
}

const YamlNode *tree_nearest(const YamlTree *tree, const char *path)
{
    const YamlNode *node = tree->root;
    YamlPathPart part;
    while (*path && path_next(&path, &part)) {
        const YamlNode *child =
            part.index < 0 ? node_child(node, part.key) : node_element(node, (size_t)part.index);
        if (!child)
            break;
        node = child;
    }
    return node;
}

const YamlNode *tree_at(const YamlTree *tree, const char *path)
{
    const YamlNode *node = tree_nearest(tree, path);
    const char *dot = strrchr(path, '.');
    return node->key && strcmp(node->key, dot ? dot + 1 : path) == 0 ? node : NULL;
}

static bool error_at(const YamlTree *tree, const char *said, int line, int column, Error *error,
                     const char *format, va_list arguments)
{
    char what[sizeof error->message];
    vsnprintf(what, sizeof what, format, arguments);
    if (said)
        return error_set(error, "%s: %s", said, what);
    return error_set(error, "%s:%d:%d: %s", tree->path, line, column, what);
}

bool tree_error(const YamlTree *tree, const YamlNode *node, Error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_at(tree, node->said, node->line, node->column, error, format, arguments);
    va_end(arguments);
    return false;
}

bool tree_error_key(const YamlTree *tree, const YamlNode *node, Error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_at(tree, node->said, node->key ? node->key_line : node->line,
             node->key ? node->key_column : node->column, error, format, arguments);
    va_end(arguments);
    return false;
}

/* Checks of a text before parsing. */

/* A UTF-8 character. */
typedef struct Character {
    unsigned code;
    size_t length; /* 0: not allowed in YAML: a control character, or not UTF-8 */
} Character;

static Character character_at(const unsigned char *at, size_t left)
{
    static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (*at < 0x80) {
        const bool taken = (*at >= 0x20 && *at != 0x7f) || *at == '\t' || *at == '\n' || *at == '\r';
        return (Character){*at, taken};
    }
    const size_t length = *at >= 0xf8 ? 0 : *at >= 0xf0 ? 4 : *at >= 0xe0 ? 3 : *at >= 0xc0 ? 2 : 0;
    if (length == 0 || length > left)
        return (Character){0, 0};
    unsigned code = *at & (0x7fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((at[i] & 0xc0) != 0x80)
            return (Character){0, 0};
        code = code << 6 | (at[i] & 0x3f);
    }
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return (Character){code, code >= least[length] && code < 0x110000 && !surrogate ? length : 0};
}

/* True if a line, and so a directive, may begin after the character: YAML's line breaks and the byte order
   mark. */
static bool begins_line(unsigned code)
{
    return code == '\n' || code == '\r' || code == 0x85 || code == 0x2028 || code == 0x2029 || code == 0xfeff;
}

/* Returns true if the bytes are UTF-8 text without control characters and directives; called first by
   yaml_read. */
static bool yaml_text_check(const YamlTree *tree, const char *said, const char *bytes, size_t size,
                            Error *error)
{
    YamlNode place = {.line = 1, .column = 1, .said = said};
    unsigned before = '\n';
    for (size_t i = 0; i < size;) {
        const Character character = character_at((const unsigned char *)bytes + i, size - i);
        if (character.length == 0)
            return tree_error(tree, &place, error, "byte 0x%02x is no text; write YAML in UTF-8",
                              (unsigned char)bytes[i]);
        /* libfyaml 0.7 hangs on a directive at the end of the text. */
        if (character.code == '%' && begins_line(before))
            return tree_error(tree, &place, error,
                              "a directive (%%NAME), which means nothing here; leave the line out");
        place.column++;
        if (character.code == '\n') {
            place.line++;
            place.column = 1;
        }
        before = character.code;
        i += character.length;
    }
    return true;
}

/* Builds the scene tree from libfyaml's events. */

/* The search for duplicate keys is quadratic: the limit keeps a megabyte of keys from taking minutes. */
enum { MAPPING_KEYS_MAX = 256 };

typedef struct YamlReader {
    YamlTree *tree;
    const char *said;
    struct fy_diag *diag;
    struct fy_parser *parser;
    struct fy_event *event; /* the present event */
    Error *error;
} YamlReader;

static bool fail_at(const YamlReader *reader, int line, int column, const char *what)
{
    const YamlNode place = {.line = line, .column = column, .said = reader->said};
    return tree_error(reader->tree, &place, reader->error, "%s", what);
}

/* True if the mark of the present event is one character too far right: after the quote, or after the '*'
   of an alias. */
static bool mark_is_behind(const YamlReader *reader)
{
    if (reader->event->type == FYET_ALIAS)
        return true;
    if (reader->event->type != FYET_SCALAR)
        return false;
    const enum fy_scalar_style style = fy_token_scalar_style(fy_event_get_token(reader->event));
    return style == FYSS_SINGLE_QUOTED || style == FYSS_DOUBLE_QUOTED;
}

/* `key:` without a value: has a position in libfyaml 0.8, none in 0.7. */
static bool is_nothing(const YamlReader *reader)
{
    if (reader->event->type != FYET_SCALAR)
        return false;
    struct fy_token *token = fy_event_get_token(reader->event);
    return !token || (fy_token_scalar_style(token) == FYSS_PLAIN && fy_token_get_text_length(token) == 0);
}

/* Fills in the start of the present event, counted from 1; unchanged if the event has no position. */
static void event_place(const YamlReader *reader, int *line, int *column)
{
    const struct fy_mark *mark = fy_event_start_mark(reader->event);
    if (!mark || is_nothing(reader))
        return;
    *line = mark->line + 1;
    *column = mark->column + 1 - mark_is_behind(reader);
}

static bool fail_here(const YamlReader *reader, const char *what)
{
    int line = 1, column = 1;
    event_place(reader, &line, &column);
    return fail_at(reader, line, column, what);
}

static bool fail_tag(const YamlReader *reader, struct fy_token *tag)
{
    const struct fy_mark *mark = fy_token_start_mark(tag);
    return fail_at(reader, mark ? mark->line + 1 : 1, mark ? mark->column + 1 : 1,
                   "a tag (!name), which means nothing here; write the value alone");
}

/* Reports libfyaml's text of the first collected error. */
static bool fail_syntax(const YamlReader *reader)
{
    void *iterator = NULL;
    for (struct fy_diag_error *found; (found = fy_diag_errors_iterate(reader->diag, &iterator));)
        if (found->type >= FYET_ERROR && found->msg) {
            char what[256];
            snprintf(what, sizeof what, "not valid YAML: %.200s; write `key: value` lines", found->msg);
            return fail_at(reader, found->line > 0 ? found->line : 1, found->column > 0 ? found->column : 1,
                           what);
        }
    return fail_at(reader, 1, 1, "not valid YAML; write `key: value` lines");
}

static void event_drop(YamlReader *reader)
{
    if (reader->event)
        fy_parser_event_free(reader->parser, reader->event);
    reader->event = NULL;
}

static bool event_next(YamlReader *reader)
{
    event_drop(reader);
    reader->event = fy_parser_parse(reader->parser);
    return reader->event || fail_syntax(reader);
}

static bool events_skip(YamlReader *reader, int count)
{
    while (count-- > 0)
        if (!event_next(reader))
            return false;
    return true;
}

/* Returns the length of a scalar's text, and copies the text to `out` unless NULL; -1 on failure. In
   libfyaml 0.7 fy_token_get_text leaks and fails if its guess of the length is too short (escaped quotes
   in a row). */
static ssize_t text_walk(struct fy_token *token, char *out)
{
    struct fy_token_iter *walk = fy_token_iter_create(token);
    if (!walk)
        return -1;
    ssize_t length = 0;
    int failed = 0;
    for (const struct fy_iter_chunk *chunk = NULL;
         (chunk = fy_token_iter_chunk_next(walk, chunk, &failed));) {
        if (out)
            memcpy(out + length, chunk->str, chunk->len);
        length += (ssize_t)chunk->len;
    }
    fy_token_iter_destroy(walk);
    return failed ? -1 : length;
}

/* The code of the first control character that is neither a line break nor a tab; -1: there is none. */
static int control_in(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        const unsigned char c = (unsigned char)text[i],
                            next = i + 1 < length ? (unsigned char)text[i + 1] : 0;
        if ((c < ' ' && !strchr("\n\r\t", c ? c : 1)) || c == 0x7f)
            return c;
        if (c == 0xc2 && next >= 0x80 && next < 0xa0) /* UTF-8 */
            return next;
    }
    return -1;
}

static bool text_copy(YamlReader *reader, const char **out)
{
    struct fy_token *token = fy_event_get_token(reader->event);
    const ssize_t length = text_walk(token, NULL);
    char *copy = length >= 0 ? tree_alloc(reader->tree, (size_t)length + 1) : NULL;
    if (!copy || text_walk(token, copy) != length)
        return fail_here(reader, "a text that cannot be read; write it plainly");
    const int control = control_in(copy, (size_t)length);
    if (control >= 0) {
        char what[96];
        snprintf(what, sizeof what,
                 "a character with the code %d, which a terminal would obey; write the text without it",
                 control);
        return fail_here(reader, what);
    }
    *out = copy;
    return true;
}

static bool read_node(YamlReader *reader, int depth, int line, int column, YamlNode **out);

static bool read_scalar(YamlReader *reader, YamlNode *node)
{
    struct fy_token *token = fy_event_get_token(reader->event);
    node->kind = NODE_SCALAR;
    node->plain = !token || fy_token_scalar_style(token) == FYSS_PLAIN;
    if (token && !text_copy(reader, &node->text))
        return false;
    if (node->plain && node->text &&
        (!*node->text || strcmp(node->text, "null") == 0 || strcmp(node->text, "~") == 0))
        node->text = NULL;
    return true;
}

static bool read_sequence(YamlReader *reader, int depth, YamlNode *node)
{
    node->kind = NODE_SEQUENCE;
    YamlNode **last = &node->first;
    for (;;) {
        if (!event_next(reader))
            return false;
        if (reader->event->type == FYET_SEQUENCE_END)
            return true;
        if (!read_node(reader, depth + 1, node->line, node->column, last))
            return false;
        assert(*last); /* made by read_pair */
        last = &(*last)->next;
    }
}

/* Reads a pair; the present event is the key. */
static bool read_pair(YamlReader *reader, int depth, const YamlNode *mapping, YamlNode **out)
{
    int line = mapping->line, column = mapping->column;
    event_place(reader, &line, &column);
    const char *key = NULL;
    if (reader->event->type != FYET_SCALAR)
        return fail_at(reader, line, column, "a key must be a name; write `name: value`");
    if (!text_copy(reader, &key))
        return false;
    if (!key || !*key)
        return fail_at(reader, line, column, "a key is empty; write `name: value`");
    const YamlNode *twin = node_child(mapping, key);
    if (twin) {
        char what[256];
        snprintf(what, sizeof what, "'%.100s' stands here twice (first in line %d); keep one of the two", key,
                 twin->key_line);
        return fail_at(reader, line, column, what);
    }
    if (!event_next(reader) || !read_node(reader, depth + 1, line, column, out))
        return false;
    (*out)->key = key;
    (*out)->key_line = line;
    (*out)->key_column = column;
    return true;
}

static bool read_mapping(YamlReader *reader, int depth, YamlNode *node)
{
    node->kind = NODE_MAPPING;
    YamlNode **last = &node->first;
    for (int keys = 0;; keys++) {
        if (!event_next(reader))
            return false;
        if (reader->event->type == FYET_MAPPING_END)
            return true;
        if (keys == MAPPING_KEYS_MAX)
            return fail_here(reader, "more than 256 keys in one mapping; nothing needs so many");
        if (!read_pair(reader, depth, node, last))
            return false;
        assert(*last); /* made by read_pair */
        last = &(*last)->next;
    }
}

/* Reads a node starting at the present event; line and column are its position if the event has none. */
static bool read_node(YamlReader *reader, int depth, int line, int column, YamlNode **out)
{
    if (depth > TREE_DEPTH_MAX)
        return fail_here(reader, "nested too deeply; nothing needs more than 32 levels");
    if (reader->event->type == FYET_ALIAS)
        return fail_here(reader, "an alias (*name), which means nothing here; write the value out");
    struct fy_token *tag = fy_event_get_tag_token(reader->event);
    if (tag)
        return fail_tag(reader, tag);
    YamlNode *node = tree_alloc(reader->tree, sizeof *node);
    if (!node)
        return fail_here(reader, "no memory to read it");
    node->line = line;
    node->column = column;
    node->said = reader->said;
    event_place(reader, &node->line, &node->column);
    *out = node;
    switch (reader->event->type) {
    case FYET_SCALAR:
        return read_scalar(reader, node);
    case FYET_SEQUENCE_START:
        return read_sequence(reader, depth, node);
    case FYET_MAPPING_START:
        return read_mapping(reader, depth, node);
    default:
        return fail_here(reader, "not valid YAML here; write `key: value` lines");
    }
}

static bool read_stream(YamlReader *reader, YamlNode **root)
{
    if (!events_skip(reader, 2)) /* the stream, then the document */
        return false;
    *root = NULL;
    if (reader->event->type == FYET_STREAM_END)
        return !reader->said || fail_at(reader, 1, 1, "no value; write path=value");
    if (!event_next(reader) || !read_node(reader, 0, 1, 1, root))
        return false;
    if (!events_skip(reader, 2)) /* the document's end, then what follows */
        return false;
    if (reader->event->type != FYET_STREAM_END)
        return fail_here(reader, "a second document; write one");
    return true;
}

bool yaml_read(YamlTree *tree, const char *said, const char *bytes, size_t size, YamlNode **root,
               Error *error)
{
    YamlReader reader = {.tree = tree, .said = said, .error = error};
    if (!yaml_text_check(tree, said, bytes, size, error))
        return false;
    struct fy_diag_cfg quiet;
    fy_diag_cfg_default(&quiet);
    quiet.fp = NULL;
    reader.diag = fy_diag_create(&quiet);
    if (!reader.diag)
        return fail_at(&reader, 1, 1, "no memory to read it");
    fy_diag_set_collect_errors(reader.diag, true);

    const struct fy_parse_cfg config = {.flags = FYPCF_QUIET | FYPCF_COLLECT_DIAG | FYPCF_JSON_NONE,
                                        .diag = reader.diag};
    reader.parser = fy_parser_create(&config);
    bool ok = reader.parser && fy_parser_set_string(reader.parser, bytes, size) == 0;
    ok = ok ? read_stream(&reader, root) : fail_at(&reader, 1, 1, "no memory to read it");
    if (reader.parser) {
        event_drop(&reader);
        fy_parser_destroy(reader.parser);
    }
    fy_diag_destroy(reader.diag);
    return ok;
}

bool tree_read(YamlTree *tree, const char *path, const char *bytes, size_t size, Error *error)
{
    *tree = (YamlTree){.path = path};
    if (!yaml_read(tree, NULL, bytes, size, &tree->root, error))
        return false;
    if (!tree->root)
        return error_set(error, "%s:1:1: the scene is empty; it needs at least box, particles and fluids",
                         path);
    if (tree->root->kind != NODE_MAPPING)
        return tree_error(
            tree, tree->root, error,
            "a scene is a mapping; write `box:`, `particles:` and `fluids:` at the left margin");
    return true;
}
