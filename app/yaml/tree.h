/* A YAML text as a tree with positions of all nodes, for the scene loader and for `--set`.

   Built from libfyaml's events: they have positions of mappings and sequences, missing in libfyaml's own
   documents; and a single arena frees all memory, also after an error. Aliases, tags, several documents
   and duplicate keys are refused. */
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
    bool plain;       /* scalar without quotes: may be a number, a boolean or empty */
    int line, column; /* counted from 1 */
    const char
        *said; /* setting on the command line: "--set path=value", "--backend cpu"; NULL: from the file */
    const char *text; /* scalar; NULL: empty */
    const char *key;  /* key of a child of a mapping */
    int key_line, key_column;
    Node *first, *next; /* children; siblings, in text order */
};

typedef struct Tree {
    const char *path; /* for messages; not owned */
    int dimensions;   /* of the scene: 2 allows vectors of two numbers; 0 or 3: three */
    Node *root;
    struct TreeBlock *blocks; /* owned: nodes and texts */
} Tree;

/* Returns zeroed memory living as long as the tree; NULL if memory is short. */
void *tree_alloc(Tree *tree, size_t size);
void tree_free(Tree *tree);

/* Child of a mapping by key, or of a sequence by index; NULL if there is none. */
const Node *node_child(const Node *mapping, const char *key);
const Node *node_element(const Node *sequence, size_t index);
size_t node_count(const Node *node);

typedef struct PathPart {
    long index; /* of a list, from 0; -1: a key */
    char key[64];
} PathPart;

/* Takes the next part of a path like `fluids[0].density`; returns false if faulty. */
bool path_next(const char **path, PathPart *part);

/* Returns the node at a path like `fluids[0].fill`, or its nearest ancestor, for messages. */
const Node *tree_near(const Tree *tree, const char *path);

/* Returns the node at the exact path; NULL if there is none. The path ends in a key. */
const Node *tree_at(const Tree *tree, const char *path);

/* Writes "place: message" and returns false. */
bool tree_error(const Tree *tree, const Node *node, Error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* The same, at the position of the node's key if there is a key. */
bool tree_error_key(const Tree *tree, const Node *node, Error *error, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
