#define _GNU_SOURCE /* asprintf */
/* `--set path=value`: edits of the scene tree. */
#include "app/scene/yaml/yaml.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* State of an edit while following the path. */
typedef struct Edit {
    YamlTree *tree;
    const char *said; /* see Node.said */
    const char *path;
    int done; /* bytes of the path already followed */
    Error *error;
} Edit;

static bool fail(const Edit *edit, const char *what)
{
    return error_set(edit->error, "%s: %s", edit->said, what);
}

static YamlNode *node_new(const Edit *edit, YamlKind kind)
{
    YamlNode *node = tree_alloc(edit->tree, sizeof *node);
    if (node)
        *node = (YamlNode){.kind = kind, .plain = true, .said = edit->said, .line = 1, .column = 1};
    return node;
}

static void node_append(YamlNode *parent, YamlNode *child)
{
    YamlNode **last = &parent->first;
    while (*last)
        last = &(*last)->next;
    *last = child;
}

/* Turns an empty node (`box:`) into the mapping or list required by the path. */
static bool become(const Edit *edit, YamlNode *node, YamlKind kind)
{
    if (node->kind == NODE_SCALAR && node->plain && !node->text) {
        node->kind = kind;
        node->said = edit->said;
    }
    return node->kind == kind;
}

/* Reports a missing mapping; in a list of mappings the index is missing. */
static bool no_mapping(const Edit *edit, const YamlNode *node, const char *key)
{
    const YamlNode *first = node->kind == NODE_SEQUENCE ? node->first : NULL;
    const char *rest = edit->path + edit->done;
    const int above = edit->done - (edit->done > 0 && rest[-1] == '.');
    if (first && first->kind == NODE_MAPPING)
        return error_set(edit->error, "%s: %.*s is a list of %zu; did you mean '%.*s[0].%s'?", edit->said,
                         above, edit->path, node_count(node), above, edit->path, rest);
    return error_set(edit->error, "%s: '%s' stands in no mapping; use an index [0] for lists", edit->said,
                     key);
}

static bool step_key(const Edit *edit, YamlNode *node, const char *key, YamlNode **child)
{
    if (!become(edit, node, NODE_MAPPING))
        return no_mapping(edit, node, key);
    *child = (YamlNode *)node_child(node, key);
    if (*child)
        return true;
    char *name = tree_alloc(edit->tree, strlen(key) + 1);
    *child = node_new(edit, NODE_SCALAR);
    if (!name || !*child)
        return fail(edit, "no memory");
    memcpy(name, key, strlen(key) + 1);
    (*child)->key = name;
    node_append(node, *child);
    return true;
}

static bool step_index(const Edit *edit, YamlNode *node, size_t index, YamlNode **child)
{
    if (!become(edit, node, NODE_SEQUENCE))
        return error_set(edit->error, "%s: [%zu] follows something that is no list; use a key", edit->said,
                         index);
    const size_t count = node_count(node);
    if (index > count)
        return error_set(edit->error, "%s: [%zu] is beyond the list's end; use at most %zu, which appends",
                         edit->said, index, count);
    *child = (YamlNode *)node_element(node, index);
    if (*child)
        return true;
    *child = node_new(edit, NODE_SCALAR);
    if (!*child)
        return fail(edit, "no memory");
    node_append(node, *child);
    return true;
}

/* Replaces `place` by `value`, keeping key and siblings. */
static void node_replace(YamlNode *place, const YamlNode *value)
{
    YamlNode node = *value;
    node.key = place->key;
    node.key_line = place->key_line;
    node.key_column = place->key_column;
    node.next = place->next;
    *place = node;
}

static bool read_value(const Edit *edit, const char *text, YamlNode **value)
{
    if (text[strspn(text, " \t")])
        return yaml_read(edit->tree, edit->said, text, strlen(text), value, edit->error);
    *value = node_new(edit, NODE_SCALAR);
    return *value || fail(edit, "no memory");
}

/* Reports a faulty index; `at` points to its '['. */
static bool fail_index(const Edit *edit, const char *at)
{
    const int length = (int)strcspn(at + 1, "]"), digits = (int)strspn(at + 1 + (at[1] == '-'), "0123456789");
    const char *behind = at + 1 + length;
    if (!*behind)
        return fail(edit, "a '[' has no ']' behind it; write an index like fluids[0]");
    if (at[1] == '-' && digits > 0 && digits == length - 1)
        return error_set(edit->error, "%s: the index %.*s is less than 0; the first entry of a list is [0]",
                         edit->said, length, at + 1);
    if (digits != length || length == 0)
        return error_set(edit->error,
                         "%s: '[%.*s]' is no index; write a whole number from 0 on, like fluids[0]",
                         edit->said, length, at + 1);
    if (behind[1] && behind[1] != '.' && behind[1] != '[')
        return error_set(edit->error, "%s: '%s' follows an index; write a '.' between them", edit->said,
                         behind + 1);
    if (behind[1] == '.' && !behind[2])
        return fail(edit, "the path ends in a '.'; name a key behind it");
    return error_set(edit->error, "%s: [%.*s] is beyond the end of any list", edit->said, length, at + 1);
}

/* Reports a faulty part of a path. */
static bool fail_part(const Edit *edit, const char *at)
{
    if (*at == '[')
        return fail_index(edit, at);
    const size_t length = strcspn(at, ".[");
    if (length == 0)
        return fail(edit, "a key is missing before a '.'; write it like fluids[0].density");
    if (at[length] == '.')
        return fail(edit, "the path ends in a '.'; name a key behind it");
    return error_set(edit->error, "%s: '%.*s' is longer than any key", edit->said, (int)length, at);
}

/* Returns "--set path=value", living as long as the tree. */
static const char *said_by_set(YamlTree *tree, const char *setting)
{
    const size_t size = sizeof "--set " + strlen(setting);
    char *said = tree_alloc(tree, size);
    if (!said)
        return "--set";
    snprintf(said, size, "--set %s", setting);
    return said;
}

bool tree_set(YamlTree *tree, const char *setting, const char *said, Error *error)
{
    char path[256] = "";
    Edit edit = {
        .tree = tree, .said = said ? said : said_by_set(tree, setting), .path = path, .error = error};
    const char *equals = strchr(setting, '=');
    if (!equals || equals == setting || (size_t)(equals - setting) >= sizeof path)
        return fail(&edit, "no setting; write path=value, such as solver.step.dt=0.01");
    memcpy(path, setting, (size_t)(equals - setting));
    path[equals - setting] = 0;

    YamlNode *value = NULL, *node = tree->root;
    if (!read_value(&edit, equals + 1, &value))
        return false;
    int depth = 0;
    for (const char *at = path; *at;) {
        YamlPathPart part;
        edit.done = (int)(at - path);
        const char *began = at;
        if (!path_next(&at, &part))
            return fail_part(&edit, began);
        if (++depth > TREE_DEPTH_MAX)
            return fail(&edit, "the path has more parts than any key");
        if (!(part.index < 0 ? step_key(&edit, node, part.key, &node)
                             : step_index(&edit, node, (size_t)part.index, &node)))
            return false;
    }
    node_replace(node, value);
    return true;
}

enum { WIDTH = 100, INDENT = 2 }; /* WIDTH: longest one-line value, bytes */

/* True if the scalar needs no quotes: no characters with a meaning in YAML. */
static bool is_plain(const YamlNode *node)
{
    return node->plain && node->text && *node->text && !strpbrk(node->text, "\n\"'#:,[]{}&*!|>%@`");
}

static void print_scalar(const YamlNode *node, FILE *file)
{
    if (node->plain && !node->text)
        return;
    if (is_plain(node)) {
        fputs(node->text, file);
        return;
    }
    fputc('"', file);
    for (const char *at = node->text ? node->text : ""; *at; at++)
        if (*at == '\n')
            fputs("\\n", file);
        else if (*at == '\t')
            fputs("\\t", file);
        else if (*at == '\r')
            fputs("\\r", file);
        else if ((unsigned char)*at < 0x20 || *at == 0x7f)
            fprintf(file, "\\x%02X", (unsigned)*at);
        else
            fprintf(file, "%s%c", *at == '"' || *at == '\\' ? "\\" : "", *at);
    fputc('"', file);
}

void node_print(const YamlNode *node, FILE *file)
{
    if (node->kind == NODE_SCALAR) {
        print_scalar(node, file);
        return;
    }
    const bool mapping = node->kind == NODE_MAPPING;
    fputc(mapping ? '{' : '[', file);
    for (const YamlNode *child = node->first; child; child = child->next) {
        if (mapping)
            fprintf(file, "%s: ", child->key);
        node_print(child, file);
        fputs(child->next ? ", " : "", file);
    }
    fputc(mapping ? '}' : ']', file);
}

/* Returns the width on one line; more than WIDTH if there is a comment inside. */
static int width(const YamlNode *node)
{
    int sum = node->text ? (int)strlen(node->text) + 2 : 2;
    for (const YamlNode *child = node->first; child && sum <= WIDTH; child = child->next)
        sum += child->said && node->kind == NODE_MAPPING
                   ? WIDTH + 1
                   : width(child) + 4 + (child->key ? (int)strlen(child->key) : 0);
    return sum;
}

static void print_children(const YamlNode *node, int indent, bool inline_first, FILE *file);

/* Prints a value after "key:" or "-"; `top`: child of the root, where mappings have their own lines. */
static void print_value(const YamlNode *node, int indent, bool top, bool in_list, FILE *file)
{
    const bool nothing = node->kind == NODE_SCALAR && node->plain && !node->text;
    const bool flow = node->kind == NODE_SCALAR || !node->first ||
                      (indent + width(node) <= WIDTH && (!top || node->kind == NODE_SEQUENCE) &&
                       !(top && node->first->kind == NODE_MAPPING));
    fputs(nothing || (!flow && !in_list) ? "" : " ", file);
    if (!flow) {
        fputs(in_list ? "" : "\n", file);
        print_children(node, indent, in_list, file);
        return;
    }
    node_print(node, file);
    if (node->said)
        fprintf(file, "%*s# %.*s", INDENT, "", (int)strcspn(node->said, "\r\n"), node->said);
    fputc('\n', file);
}

/* `inline_first`: the first child follows the "-" of a list. */
static void print_children(const YamlNode *node, int indent, bool inline_first, FILE *file)
{
    for (const YamlNode *child = node->first; child; child = child->next) {
        const bool mapping = node->kind == NODE_MAPPING;
        fprintf(file, "%*s%s%s", inline_first && child == node->first ? 0 : indent, "",
                mapping ? child->key : "-", mapping ? ":" : "");
        print_value(child, indent + INDENT, indent == 0, !mapping, file);
    }
}

void tree_print(const YamlTree *tree, FILE *file)
{
    if (tree->root)
        print_children(tree->root, 0, false, file);
}

/* A text being changed. */
typedef struct Patch {
    const char *path, *text, *setting;
    size_t size;
    YamlTree before, after; /* tree of the text; wanted tree, with the setting */
} Patch;

/* True if two nodes have the same contents, in any order of keys. */
static bool same(const YamlNode *a, const YamlNode *b)
{
    if (!a || !b || a->kind != b->kind || !a->text != !b->text || node_count(a) != node_count(b) ||
        (a->text && (a->plain != b->plain || strcmp(a->text, b->text) != 0)))
        return false;
    const YamlNode *of_b = b->first;
    for (const YamlNode *child = a->first; child; child = child->next) {
        if (!same(child, a->kind == NODE_MAPPING ? node_child(b, child->key) : of_b))
            return false;
        of_b = of_b->next;
    }
    return true;
}

/* True if the text gives the wanted tree; false for NULL. */
static bool is_right(const Patch *patch, const char *text)
{
    YamlTree tree = {.path = NULL};
    Error none;
    const bool right = text && tree_read(&tree, patch->path, text, strlen(text), &none) &&
                       same(tree.root, patch->after.root);
    tree_free(&tree);
    return right;
}

/* Returns the text with `length` bytes at `at` replaced. */
static char *replaced(const Patch *patch, size_t at, size_t length, const char *by)
{
    char *out = NULL;
    if (asprintf(&out, "%.*s%s%.*s", (int)at, patch->text, by, (int)(patch->size - at - length),
                 patch->text + at + length) < 0)
        return NULL;
    return out;
}

/* Returns the offset of a line and column; columns count characters. */
static size_t offset_of(const Patch *patch, int line, int column)
{
    size_t at = 0;
    while (line > 1 && at < patch->size)
        if (patch->text[at++] == '\n')
            line--;
    while (column > 1 && at < patch->size) {
        at++;
        while (at < patch->size && ((unsigned char)patch->text[at] & 0xc0) == 0x80)
            at++;
        column--;
    }
    return at;
}

/* Returns the length of a quoted text, bytes; 0: no end. */
static size_t quoted_length(const char *text)
{
    for (size_t i = 1; text[i]; i++) {
        if (text[i] == '\\' && *text == '"' && text[i + 1])
            i++;
        else if (text[i] == *text)
            return i + 1;
    }
    return 0;
}

/* Returns the length of a bracketed value; 0 also if it contains a comment, which would be lost. */
static size_t bracket_length(const char *text)
{
    int depth = 0;
    for (size_t i = 0; text[i]; i++) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            const size_t length = quoted_length(text + i);
            if (length == 0)
                return 0;
            i += length - 1;
        } else if (c == '#') {
            return 0;
        }
        depth += (c == '[' || c == '{') - (c == ']' || c == '}');
        if (depth == 0)
            return i + 1;
    }
    return 0;
}

/* Returns the length of a value; 0: neither on one line nor in brackets. */
static size_t value_length(const YamlNode *node, const char *text)
{
    if (*text == '[' || *text == '{')
        return bracket_length(text);
    if (*text == '"' || *text == '\'')
        return quoted_length(text);
    const bool plain = node->kind == NODE_SCALAR && node->text && *node->text;
    return plain && strncmp(text, node->text, strlen(node->text)) == 0 ? strlen(node->text) : 0;
}

/* ---- in place ---- */

/* Inserts "key: value" into `parent`. */
static char *inserted(const Patch *patch, const YamlNode *parent, const char *key, const char *value)
{
    const YamlNode *first = parent->first;
    const size_t at = offset_of(patch, parent->line, parent->column);
    char *words = NULL, *out = NULL;
    if (parent->kind != NODE_MAPPING || at >= patch->size)
        return NULL;
    if (patch->text[at] == '{') {
        if (asprintf(&words, "%s: %s%s", key, value, first ? ", " : "") >= 0)
            out = replaced(patch, at + 1, 0, words);
    } else if (parent == patch->before.root) {
        const bool ended = patch->text[patch->size - 1] == '\n';
        if (asprintf(&words, "%s%s: %s\n", ended ? "" : "\n", key, value) >= 0)
            out = replaced(patch, patch->size, 0, words);
    } else if (first) {
        if (asprintf(&words, "%s: %s\n%*s", key, value, first->key_column - 1, "") >= 0)
            out = replaced(patch, offset_of(patch, first->key_line, first->key_column), 0, words);
    }
    free(words);
    return out;
}

/* Turns "b.c", "1" into "{b: {c: 1}}": the missing part of a path as nested mappings. */
static char *nested(const char *rest, const char *value)
{
    YamlPathPart part;
    char *inner = NULL, *out = NULL;
    if (!*rest)
        return strdup(value);
    if (!path_next(&rest, &part) || !(inner = nested(rest, value)))
        return NULL;
    const int made = part.index < 0    ? asprintf(&out, "{%s: %s}", part.key, inner)
                     : part.index == 0 ? asprintf(&out, "[%s]", inner)
                                       : -1;
    free(inner);
    return made < 0 ? NULL : out;
}

static char *in_place(const Patch *patch)
{
    char path[256];
    const char *value = strchr(patch->setting, '=') + 1, *at = path;
    const YamlNode *node = patch->before.root, *parent = NULL;
    YamlPathPart part = {.index = -1};
    snprintf(path, sizeof path, "%.*s", (int)(value - 1 - patch->setting), patch->setting);
    while (node && *at && path_next(&at, &part)) {
        parent = node;
        node = part.index < 0 ? node_child(node, part.key) : node_element(node, (size_t)part.index);
    }
    if (node && !*at) {
        const size_t from = offset_of(patch, node->line, node->column);
        const size_t length = from < patch->size ? value_length(node, patch->text + from) : 0;
        return length ? replaced(patch, from, length, value) : NULL;
    }
    char *whole = parent && part.index < 0 ? nested(at, value) : NULL;
    char *out = whole ? inserted(patch, parent, part.key, whole) : NULL;
    free(whole);
    return out;
}

/* ---- the block of the first key ---- */

/* Removes the comments after values: they are meant for readers of printed settings. */
static void silence(YamlNode *node)
{
    for (; node; node = node->next) {
        node->said = NULL;
        silence(node->first);
    }
}

static char *block_of(YamlNode *child)
{
    YamlNode alone = *child, root = {.kind = NODE_MAPPING, .first = &alone};
    const YamlTree tree = {.root = &root};
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    alone.next = NULL;
    if (!file)
        return NULL;
    tree_print(&tree, file);
    if (fclose(file) == 0)
        return text;
    free(text);
    return NULL;
}

/* Returns the start of the comment above a line, or of the line. */
static size_t above(const Patch *patch, size_t at)
{
    while (at > 0) {
        size_t line = at - 1;
        while (line > 0 && patch->text[line - 1] != '\n')
            line--;
        const char *words = patch->text + line;
        words += strspn(words, " \t\r");
        if (*words != '#' && *words != '\n')
            break;
        at = line;
    }
    return at;
}

static char *by_block(const Patch *patch)
{
    char path[256];
    const char *at = path;
    YamlPathPart part;
    snprintf(path, sizeof path, "%.*s", (int)strcspn(patch->setting, "="), patch->setting);
    if (!path_next(&at, &part) || part.index >= 0)
        return NULL;
    const YamlNode *old = node_child(patch->before.root, part.key);
    YamlNode *now = (YamlNode *)node_child(patch->after.root, part.key);
    char *block = now ? block_of(now) : NULL, *out = NULL;
    if (block && old && old->key_column == 1) {
        const size_t from = offset_of(patch, old->key_line, 1);
        const size_t end = old->next ? above(patch, offset_of(patch, old->next->key_line, 1)) : patch->size;
        out = end >= from ? replaced(patch, from, end - from, block) : NULL;
    } else if (block && !old) {
        out = replaced(patch, patch->size, 0, block);
    }
    free(block);
    return out;
}

static char *by_tree(const Patch *patch)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return NULL;
    tree_print(&patch->after, file);
    if (fclose(file) == 0)
        return text;
    free(text);
    return NULL;
}

/* ---- all methods in turn ---- */

static char *patched(Patch *patch, bool *lost)
{
    static char *(*const ways[])(const Patch *) = {in_place, by_block, by_tree};
    silence(patch->after.root);
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        char *text = ways[i](patch);
        if (is_right(patch, text)) {
            if (lost)
                *lost |= i > 0;
            return text;
        }
        free(text);
    }
    return NULL;
}

char *yaml_patch(const char *path, const char *text, size_t size, const char *setting, bool *lost,
                 Error *error)
{
    char *whole = strndup(text, size), *out = NULL;
    Patch patch = {.path = path, .text = whole, .size = whole ? strlen(whole) : 0, .setting = setting};
    if (!whole) {
        error_set(error, "%s: no memory", path);
        return NULL;
    }
    if (tree_read(&patch.before, path, whole, patch.size, error) &&
        tree_read(&patch.after, path, whole, patch.size, error) &&
        tree_set(&patch.after, setting, NULL, error)) {
        out = patched(&patch, lost);
        if (!out)
            error_set(error, "%s: %s has no place in it", path, setting);
    }
    tree_free(&patch.before);
    tree_free(&patch.after);
    free(whole);
    return out;
}
