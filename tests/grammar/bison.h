/* SPDX-License-Identifier: Apache-2.0 */
/* Stands before the parser that bison makes of docs/grammar.y: where it gets its tokens, and where
   its trace goes. */
#ifndef MMS_TESTS_GRAMMAR_BISON_H
#define MMS_TESTS_GRAMMAR_BISON_H

#include <stdio.h> /* which bison takes only with its own YYFPRINTF */

#ifdef __cplusplus
extern "C" {
#endif

int yylex(void);
void yyerror(const char* message);
int mms_grammar_trace(void* file, const char* format, ...);

#ifdef __cplusplus
}
#endif

#define YYDEBUG 1
#define YYFPRINTF mms_grammar_trace
#define YYMAXDEPTH 1000000

#endif
