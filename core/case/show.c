/* show.c - see show.h. What is short stands on one line in flow style, the rest in blocks;
 * texts are quoted only where YAML would read them as something else. */
#include "case/show.h"

#include <ctype.h>
#include <string.h>

enum { SHOW_WIDTH = 110, SHOW_INDENT = 2, SHOW_KEY = 12 }; /* SHOW_KEY: room for a key */

static void show_quoted(struct text *text, const char *words)
{
    text_add_n(text, "\"", 1);
    for (const unsigned char *at = (const unsigned char *)words; *at; at++) {
        if (*at == '"' || *at == '\\') text_add(text, "\\%c", *at);
        else if (*at == '\n') text_add_n(text, "\\n", 2);
        else if (*at == '\t') text_add_n(text, "\\t", 2);
        else if (*at < 32 || *at == 127) text_add(text, "\\x%02x", *at);
        else text_add_n(text, (const char *)at, 1);
    }
    text_add_n(text, "\"", 1);
}

/* Would the text, unquoted, read back as the same text, wherever it stands? */
static bool show_is_safe(const char *words)
{
    unsigned char first = (unsigned char)*words;
    if (!first || !(isalnum(first) || strchr("_./+=-", first) || first >= 128)) return false;
    if (first == '-' && !isdigit((unsigned char)words[1]) && words[1] != '.') return false;
    if (strcmp(words, "=") == 0 || strncmp(words, "...", 3) == 0) return false;
    for (const unsigned char *at = (const unsigned char *)words; *at; at++) {
        if (*at < 32 || *at == 127 || strchr(",[]{}\"'`\\&*!|>%@", *at)) {
            bool operator= strchr("*%>&|!", *at) && *at &&at != (const unsigned char *)words;
            if (!operator) return false;
        }
        if (*at == ':' && (at[1] == ' ' || at[1] == '\0')) return false;
        if (*at == '#' && at != (const unsigned char *)words && at[-1] == ' ') return false;
        if (*at == ' ' && at[1] == '\0') return false;
    }
    return true;
}

/* A quoted text that would be a number, flag or nothing without its quotes. */
static bool show_is_word(const struct node *node)
{
    struct node plain = *node;
    bool flag;
    double number;
    plain.style = TREE_PLAIN;
    if (tree_is_null(&plain) || tree_flag(&plain, &flag)) return false;
    size_t read = text_number(node->text, &number);
    return read == 0 || node->text[read] != '\0';
}

static void show_scalar(struct text *text, const struct node *node)
{
    if (show_is_safe(node->text) && (node->style == TREE_PLAIN || show_is_word(node))) text_add(text, "%s", node->text);
    else show_quoted(text, node->text);
}

static bool show_is_block_text(const struct node *node)
{
    if (node->kind != TREE_SCALAR || !strchr(node->text, '\n')) return false;
    for (const unsigned char *at = (const unsigned char *)node->text; *at; at++)
        if ((*at < 32 && *at != '\n' && *at != '\t') || *at == 127) return false;
    return true;
}

/* Lines below a `|`, indented. */
static void show_block_text(struct text *text, const char *words, int indent)
{
    size_t length = strlen(words);
    const char *chomp = words[length - 1] != '\n' ? "-" : length > 1 && words[length - 2] == '\n' ? "+" : "";
    if (length == 1) chomp = "+";
    text_add(text, "|");
    if (*words == ' ' || *words == '\n') text_add(text, "%d", SHOW_INDENT);
    text_add(text, "%s\n", chomp);
    while (*words) {
        int line = (int)strcspn(words, "\n");
        if (line) text_add(text, "%*s%.*s", indent, "", line, words);
        words += line;
        text_add(text, "\n");
        if (*words) words++;
    }
}

static bool show_has_block_text(const struct node *node)
{
    if (show_is_block_text(node)) return true;
    for (unsigned i = 0; i < node->count; i++)
        if (show_has_block_text(node->items[i])) return true;
    return false;
}

void show_value(const struct node *node, struct text *text)
{
    if (node->kind == TREE_SCALAR) {
        show_scalar(text, node);
        return;
    }
    text_add(text, node->kind == TREE_MAP ? "{" : "[");
    for (unsigned i = 0; i < node->count; i++) {
        if (i) text_add(text, ", ");
        if (node->kind == TREE_MAP) {
            show_scalar(text, node->keys[i]);
            text_add(text, ": ");
        }
        show_value(node->items[i], text);
    }
    text_add(text, node->kind == TREE_MAP ? "}" : "]");
}

/* Writes the node in one line if it fits, and says whether it did. */
static bool show_fits(struct text *text, const struct node *node, int column)
{
    if (node->kind == TREE_SCALAR && show_is_block_text(node)) return false;
    if (node->kind != TREE_SCALAR && show_has_block_text(node)) return false;
    size_t before = text->length;
    show_value(node, text);
    if (node->kind == TREE_SCALAR || node->count == 0 || text->length - before + (size_t)column <= SHOW_WIDTH)
        return true;
    text->length = before;
    return false;
}

static void show_block(struct text *text, const struct node *node, int indent, bool continued);

/* What follows a key or introduces an entry of a list. */
static void show_item(struct text *text, const struct node *item, int indent, bool dash)
{
    size_t before = text->length;
    text_add(text, dash ? "- " : ": ");
    if (show_fits(text, item, indent + SHOW_KEY)) text_add(text, "\n");
    else if (item->kind == TREE_SCALAR) show_block_text(text, item->text, indent + SHOW_INDENT);
    else {
        if (!dash) {
            text->length = before;
            text_add(text, ":\n");
        }
        show_block(text, item, indent + SHOW_INDENT, dash);
    }
}

/* A map or list in block style; `continued`: its first entry stands on the line that is open. */
static void show_block(struct text *text, const struct node *node, int indent, bool continued)
{
    for (unsigned i = 0; i < node->count; i++) {
        if (i || !continued) text_add(text, "%*s", indent, "");
        if (node->kind == TREE_MAP) show_scalar(text, node->keys[i]);
        show_item(text, node->items[i], indent, node->kind == TREE_LIST);
    }
}

/* The sections of the top level are opened up, however short. */
static bool show_opens(const struct node *item)
{
    if (item->kind == TREE_SCALAR || item->count == 0) return false;
    return item->kind == TREE_MAP ? item->count > 2 : item->items[0]->kind == TREE_MAP;
}

void show_tree(const struct node *root, struct text *text)
{
    for (unsigned i = 0; i < root->count; i++) {
        show_scalar(text, root->keys[i]);
        if (show_opens(root->items[i])) {
            text_add(text, ":\n");
            show_block(text, root->items[i], SHOW_INDENT, false);
        } else show_item(text, root->items[i], 0, false);
    }
}
