/* `--set path=value`: edits of the scene tree. */
#include "app/yaml/yaml.h"

#include <stdio.h>
#include <string.h>

/* State of an edit while following the path. */
typedef struct Edit {
    Tree *tree;
    const char *said; /* see Node.said */
    const char *path;
    int done; /* bytes of the path already followed */
    Error *error;
} Edit;

static bool fail(const Edit *edit, const char *what)
{
    return error_set(edit->error, "%s: %s", edit->said, what);
}

static Node *node_new(const Edit *edit, NodeKind kind)
{
    Node *node = tree_alloc(edit->tree, sizeof *node);
    if (node)
        *node = (Node){.kind = kind, .plain = true, .said = edit->said, .line = 1, .column = 1};
    return node;
}

static void node_append(Node *parent, Node *child)
{
    Node **last = &parent->first;
    while (*last)
        last = &(*last)->next;
    *last = child;
}

/* Turns an empty node (`box:`) into the mapping or list required by the path. */
static bool become(const Edit *edit, Node *node, NodeKind kind)
{
    if (node->kind == NODE_SCALAR && node->plain && !node->text) {
        node->kind = kind;
        node->said = edit->said;
    }
    return node->kind == kind;
}

/* Reports a missing mapping; in a list of mappings the index is missing. */
static bool no_mapping(const Edit *edit, const Node *node, const char *key)
{
    const Node *first = node->kind == NODE_SEQUENCE ? node->first : NULL;
    const char *rest = edit->path + edit->done;
    const int above = edit->done - (edit->done > 0 && rest[-1] == '.');
    if (first && first->kind == NODE_MAPPING)
        return error_set(edit->error, "%s: %.*s is a list of %zu; did you mean '%.*s[0].%s'?", edit->said,
                         above, edit->path, node_count(node), above, edit->path, rest);
    return error_set(edit->error, "%s: '%s' stands in no mapping; use an index [0] for lists", edit->said,
                     key);
}

static bool step_key(const Edit *edit, Node *node, const char *key, Node **child)
{
    if (!become(edit, node, NODE_MAPPING))
        return no_mapping(edit, node, key);
    *child = (Node *)node_child(node, key);
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

static bool step_index(const Edit *edit, Node *node, size_t index, Node **child)
{
    if (!become(edit, node, NODE_SEQUENCE))
        return error_set(edit->error, "%s: [%zu] follows something that is no list; use a key", edit->said,
                         index);
    const size_t count = node_count(node);
    if (index > count)
        return error_set(edit->error, "%s: [%zu] is beyond the list's end; use at most %zu, which appends",
                         edit->said, index, count);
    *child = (Node *)node_element(node, index);
    if (*child)
        return true;
    *child = node_new(edit, NODE_SCALAR);
    if (!*child)
        return fail(edit, "no memory");
    node_append(node, *child);
    return true;
}

/* Replaces `place` by `value`, keeping key and siblings. */
static void node_replace(Node *place, const Node *value)
{
    Node node = *value;
    node.key = place->key;
    node.key_line = place->key_line;
    node.key_column = place->key_column;
    node.next = place->next;
    *place = node;
}

static bool read_value(const Edit *edit, const char *text, Node **value)
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
static const char *said_by_set(Tree *tree, const char *setting)
{
    const size_t size = sizeof "--set " + strlen(setting);
    char *said = tree_alloc(tree, size);
    if (!said)
        return "--set";
    snprintf(said, size, "--set %s", setting);
    return said;
}

bool tree_set(Tree *tree, const char *setting, const char *said, Error *error)
{
    char path[256] = "";
    Edit edit = {
        .tree = tree, .said = said ? said : said_by_set(tree, setting), .path = path, .error = error};
    const char *equals = strchr(setting, '=');
    if (!equals || equals == setting || (size_t)(equals - setting) >= sizeof path)
        return fail(&edit, "no setting; write path=value, such as solver.step.dt=0.01");
    memcpy(path, setting, (size_t)(equals - setting));
    path[equals - setting] = 0;

    Node *value = NULL, *node = tree->root;
    if (!read_value(&edit, equals + 1, &value))
        return false;
    int depth = 0;
    for (const char *at = path; *at;) {
        PathPart part;
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
