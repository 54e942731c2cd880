/* Memory between two pages that cannot be touched: who reads or writes past either end dies at once. */
#ifndef IRIS_TEST_GUARDED_H
#define IRIS_TEST_GUARDED_H

#include <stddef.h>
#include <stdint.h>

/* Are there such pages? 0 on bare metal. */
int guarded_by_pages(void);

/* What guarded_memory gives is a whole number of these. */
size_t guarded_page_bytes(void);

/* `bytes`, a multiple of guarded_page_bytes, with such a page on both sides; null when there are none. Never given back. */
uint8_t *guarded_memory(size_t bytes);

#endif
