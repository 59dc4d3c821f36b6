#include "app/yaml/print.h"

#include <stdbool.h>
#include <string.h>

enum { WIDTH = 100, INDENT = 2 }; /* WIDTH: longest one-line value, bytes */

/* True if the scalar needs no quotes: no characters with a meaning in YAML. */
static bool is_plain(const Node *node)
{
    return node->plain && node->text && *node->text && !strpbrk(node->text, "\n\"'#:,[]{}&*!|>%@`");
}

static void print_scalar(const Node *node, FILE *file)
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

void node_print(const Node *node, FILE *file)
{
    if (node->kind == NODE_SCALAR) {
        print_scalar(node, file);
        return;
    }
    const bool mapping = node->kind == NODE_MAPPING;
    fputc(mapping ? '{' : '[', file);
    for (const Node *child = node->first; child; child = child->next) {
        if (mapping)
            fprintf(file, "%s: ", child->key);
        node_print(child, file);
        fputs(child->next ? ", " : "", file);
    }
    fputc(mapping ? '}' : ']', file);
}

/* Returns the width on one line; more than WIDTH if there is a comment inside. */
static int width(const Node *node)
{
    int sum = node->text ? (int)strlen(node->text) + 2 : 2;
    for (const Node *child = node->first; child && sum <= WIDTH; child = child->next)
        sum += child->said && node->kind == NODE_MAPPING
                   ? WIDTH + 1
                   : width(child) + 4 + (child->key ? (int)strlen(child->key) : 0);
    return sum;
}

static void print_children(const Node *node, int indent, bool inline_first, FILE *file);

/* Prints a value after "key:" or "-"; `top`: child of the root, where mappings have their own lines. */
static void print_value(const Node *node, int indent, bool top, bool in_list, FILE *file)
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
static void print_children(const Node *node, int indent, bool inline_first, FILE *file)
{
    for (const Node *child = node->first; child; child = child->next) {
        const bool mapping = node->kind == NODE_MAPPING;
        fprintf(file, "%*s%s%s", inline_first && child == node->first ? 0 : indent, "",
                mapping ? child->key : "-", mapping ? ":" : "");
        print_value(child, indent + INDENT, indent == 0, !mapping, file);
    }
}

void tree_print(const Tree *tree, FILE *file)
{
    if (tree->root)
        print_children(tree->root, 0, false, file);
}
