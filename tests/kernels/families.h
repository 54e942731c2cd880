/* The families of row kernels: one line for each file beside this one. Included with KERNEL_FAMILY defined. */
KERNEL_FAMILY(color)
KERNEL_FAMILY(threshold)
