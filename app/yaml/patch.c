#define _GNU_SOURCE /* asprintf */
#include "app/yaml/patch.h"

#include "app/yaml/print.h"
#include "app/yaml/yaml.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A text being changed. */
typedef struct Patch {
    const char *path, *text, *setting;
    size_t size;
    Tree before, after; /* tree of the text; wanted tree, with the setting */
} Patch;

/* True if two nodes have the same contents, in any order of keys. */
static bool same(const Node *a, const Node *b)
{
    if (!a || !b || a->kind != b->kind || !a->text != !b->text || node_count(a) != node_count(b) ||
        (a->text && (a->plain != b->plain || strcmp(a->text, b->text) != 0)))
        return false;
    const Node *of_b = b->first;
    for (const Node *child = a->first; child; child = child->next) {
        if (!same(child, a->kind == NODE_MAPPING ? node_child(b, child->key) : of_b))
            return false;
        of_b = of_b->next;
    }
    return true;
}

/* True if the text gives the wanted tree; false for NULL. */
static bool is_right(const Patch *patch, const char *text)
{
    Tree tree = {.path = NULL};
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
static size_t value_length(const Node *node, const char *text)
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
static char *inserted(const Patch *patch, const Node *parent, const char *key, const char *value)
{
    const Node *first = parent->first;
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
    PathPart part;
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
    const Node *node = patch->before.root, *parent = NULL;
    PathPart part = {.index = -1};
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
static void silence(Node *node)
{
    for (; node; node = node->next) {
        node->said = NULL;
        silence(node->first);
    }
}

static char *block_of(Node *child)
{
    Node alone = *child, root = {.kind = NODE_MAPPING, .first = &alone};
    const Tree tree = {.root = &root};
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
    PathPart part;
    snprintf(path, sizeof path, "%.*s", (int)strcspn(patch->setting, "="), patch->setting);
    if (!path_next(&at, &part) || part.index >= 0)
        return NULL;
    const Node *old = node_child(patch->before.root, part.key);
    Node *now = (Node *)node_child(patch->after.root, part.key);
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
