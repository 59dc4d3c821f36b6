/* A YAML text as a tree in which every node knows its place: what the scene loader reads and `--set` edits.

   It is built from libfyaml's events, because these carry the marks of mappings and sequences, which the
   nodes of libfyaml's own documents do not; and because one arena then frees whatever was read, also after an
   error. Aliases, tags, several documents and duplicate keys are refused. */
#ifndef SLOSH_SCENE_TREE_H
#define SLOSH_SCENE_TREE_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum { TREE_DEPTH_MAX = 32 };

typedef enum NodeKind { NODE_SCALAR, NODE_MAPPING, NODE_SEQUENCE } NodeKind;

typedef struct Node Node;
struct Node {
    NodeKind kind;
    bool plain;       /* scalar without quotes: may be a number, a boolean or nothing at all */
    int line, column; /* counted from 1 */
    const char
        *said; /* where the command line said it: "--set path=value", "--backend cpu"; NULL: the file */
    const char *text; /* scalar; NULL: nothing stands there */
    const char *key;  /* as a child of a mapping */
    int key_line, key_column;
    Node *first, *next; /* children; siblings, in the order of the text */
};

typedef struct Tree {
    const char *path; /* what messages name; not owned */
    int dimensions;   /* of the scene: 2 allows vectors of two numbers; 0 or 3: three */
    Node *root;
    struct TreeBlock *blocks; /* owned: nodes and texts */
} Tree;

/* Zeroed memory that lives as long as the tree; NULL when there is none left. */
void *tree_alloc(Tree *tree, size_t size);
void tree_free(Tree *tree);

/* The child of a mapping by key, of a sequence by index; NULL when there is none. */
const Node *node_child(const Node *mapping, const char *key);
const Node *node_element(const Node *sequence, size_t index);
size_t node_count(const Node *node);

typedef struct PathPart {
    long index; /* of a list, from 0; -1: a key */
    char key[64];
} PathPart;

/* Takes the next part off a path like `fluids[0].density`; false when it is none. */
bool path_next(const char **path, PathPart *part);

/* The node at a path like `fluids[0].fill`, or the nearest one above it: something that a message can point
 * at. */
const Node *tree_near(const Tree *tree, const char *path);

/* The node at the path itself; NULL when nothing stands there. The path ends in a key. */
const Node *tree_at(const Tree *tree, const char *path);

/* Writes "place: message" and returns false. */
bool tree_error(const Tree *tree, const Node *node, Error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The same, pointing at the node's key where it has one. */
bool tree_error_key(const Tree *tree, const Node *node, Error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
