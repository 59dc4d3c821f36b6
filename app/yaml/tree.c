#include "app/yaml/tree.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct TreeBlock TreeBlock;
struct TreeBlock {
    TreeBlock *next;
    size_t used;
    _Alignas(16) char bytes[];
};

enum { BLOCK_BYTES = 16384 };

void *tree_alloc(Tree *tree, size_t size)
{
    size = (size + 15) & ~(size_t)15;
    TreeBlock *block = tree->blocks;
    if (!block || size > BLOCK_BYTES - block->used) {
        const size_t room = size > BLOCK_BYTES ? size : BLOCK_BYTES;
        block = calloc(1, sizeof *block + room);
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

void tree_free(Tree *tree)
{
    while (tree->blocks) {
        TreeBlock *next = tree->blocks->next;
        free(tree->blocks);
        tree->blocks = next;
    }
    tree->root = NULL;
}

const Node *node_child(const Node *mapping, const char *key)
{
    for (const Node *node = mapping->first; node; node = node->next)
        if (node->key && strcmp(node->key, key) == 0)
            return node;
    return NULL;
}

const Node *node_element(const Node *sequence, size_t index)
{
    const Node *node = sequence->first;
    while (node && index--)
        node = node->next;
    return node;
}

size_t node_count(const Node *node)
{
    size_t count = 0;
    for (const Node *child = node->first; child; child = child->next)
        count++;
    return count;
}

bool path_next(const char **path, PathPart *part)
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

const Node *tree_near(const Tree *tree, const char *path)
{
    const Node *node = tree->root;
    PathPart part;
    while (*path && path_next(&path, &part)) {
        const Node *child =
            part.index < 0 ? node_child(node, part.key) : node_element(node, (size_t)part.index);
        if (!child)
            break;
        node = child;
    }
    return node;
}

const Node *tree_at(const Tree *tree, const char *path)
{
    const Node *node = tree_near(tree, path);
    const char *dot = strrchr(path, '.');
    return node->key && strcmp(node->key, dot ? dot + 1 : path) == 0 ? node : NULL;
}

static bool error_at(const Tree *tree, const char *said, int line, int column, Error *error,
                     const char *format, va_list arguments)
{
    char what[sizeof error->message];
    vsnprintf(what, sizeof what, format, arguments);
    if (said)
        return error_set(error, "%s: %s", said, what);
    return error_set(error, "%s:%d:%d: %s", tree->path, line, column, what);
}

bool tree_error(const Tree *tree, const Node *node, Error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_at(tree, node->said, node->line, node->column, error, format, arguments);
    va_end(arguments);
    return false;
}

bool tree_error_key(const Tree *tree, const Node *node, Error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_at(tree, node->said, node->key ? node->key_line : node->line,
             node->key ? node->key_column : node->column, error, format, arguments);
    va_end(arguments);
    return false;
}
