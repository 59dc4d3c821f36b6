/* `--set path=value`: edits of the scene tree. */
#include "app/scene_yaml.h"

#include <string.h>

/* An edit on its way down the path. */
typedef struct Edit {
    Tree *tree;
    const char *setting;
    Error *error;
} Edit;

static bool fail(const Edit *edit, const char *what)
{
    return error_set(edit->error, "--set %s: %s", edit->setting, what);
}

static Node *node_new(const Edit *edit, NodeKind kind)
{
    Node *node = tree_alloc(edit->tree, sizeof *node);
    if (node)
        *node = (Node){.kind = kind, .plain = true, .setting = edit->setting, .line = 1, .column = 1};
    return node;
}

static void node_append(Node *parent, Node *child)
{
    Node **last = &parent->first;
    while (*last)
        last = &(*last)->next;
    *last = child;
}

/* What stands empty (`box:`) becomes the mapping or list that the path wants. */
static bool become(const Edit *edit, Node *node, NodeKind kind)
{
    if (node->kind == NODE_SCALAR && node->plain && !node->text) {
        node->kind = kind;
        node->setting = edit->setting;
    }
    return node->kind == kind;
}

static bool step_key(const Edit *edit, Node *node, const char *key, Node **child)
{
    if (!become(edit, node, NODE_MAPPING))
        return error_set(edit->error, "--set %s: '%s' stands in no mapping; use an index [0] for lists",
                         edit->setting, key);
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
        return error_set(edit->error, "--set %s: [%zu] follows something that is no list; use a key",
                         edit->setting, index);
    const size_t count = node_count(node);
    if (index > count)
        return error_set(edit->error,
                         "--set %s: [%zu] is beyond the list's end; use at most %zu, which appends",
                         edit->setting, index, count);
    *child = (Node *)node_element(node, index);
    if (*child)
        return true;
    *child = node_new(edit, NODE_SCALAR);
    if (!*child)
        return fail(edit, "no memory");
    node_append(node, *child);
    return true;
}

/* `place` becomes `value`, but keeps its key and its neighbours. */
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
        return yaml_read(edit->tree, edit->setting, text, strlen(text), value, edit->error);
    *value = node_new(edit, NODE_SCALAR);
    return *value || fail(edit, "no memory");
}

bool tree_set(Tree *tree, const char *setting, Error *error)
{
    const Edit edit = {tree, setting, error};
    const char *equals = strchr(setting, '=');
    char path[256];
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
        if (!path_next(&at, &part) || ++depth > TREE_DEPTH_MAX)
            return fail(&edit, "no path before the '='; write it like fluids[0].density");
        if (!(part.index < 0 ? step_key(&edit, node, part.key, &node)
                             : step_index(&edit, node, (size_t)part.index, &node)))
            return false;
    }
    node_replace(node, value);
    return true;
}
