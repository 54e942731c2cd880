/* QEMU plugin: counts the instructions executed between two markers, exactly and repeatably.
 *
 *     qemu-... -plugin libicnt.so,out=FILE        one count per line, in the order in which regions ended
 *
 * A marker is an instruction that does nothing and that no compiler writes: moving a register to itself.
 *             A64            A32, Thumb      x86-64
 *     start   mov x27, x27   mov r10, r10    xchg %bx, %bx
 *     stop    mov x28, x28   mov r11, r11    xchg %cx, %cx
 *
 * The plugin interface (version 1, QEMU 4.2 to 8.x) is declared here because distributions ship no header for it.
 */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef struct qemu_info qemu_info;

enum { CALLBACK_READS_NO_REGISTERS = 0, INLINE_ADD_U64 = 0 };

void qemu_plugin_register_vcpu_tb_trans_cb(uint64_t id,
                                           void (*translated)(uint64_t id, struct qemu_plugin_tb *block));
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *block);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *block, size_t index);
const void *qemu_plugin_insn_data(const struct qemu_plugin_insn *insn);
size_t qemu_plugin_insn_size(const struct qemu_plugin_insn *insn);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *insn,
                                            void (*executed)(unsigned cpu, void *user), int flags,
                                            void *user);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *insn, int operation, void *counter,
                                                uint64_t operand);

#define EXPORT __attribute__((visibility("default")))
EXPORT int qemu_plugin_version = 1;
EXPORT int qemu_plugin_install(uint64_t id, const qemu_info *info, int argc, char **argv);

static uint64_t executed, at_start;
static FILE *out;

static void on_start(unsigned cpu, void *user)
{
    (void)cpu;
    (void)user;
    at_start = executed;
}

/* Between the two callbacks the start marker itself was counted. */
static void on_stop(unsigned cpu, void *user)
{
    (void)cpu;
    (void)user;
    fprintf(out, "%llu\n", (unsigned long long)(executed - at_start - 1));
    fflush(out);
}

static void on_translation(uint64_t id, struct qemu_plugin_tb *block)
{
    (void)id;
    static const struct {
        size_t size;
        uint32_t start, stop;
    } markers[] = {{4, 0xaa1b03fbu, 0xaa1c03fcu},
                   {4, 0xe1a0a00au, 0xe1a0b00bu},
                   {2, 0x46d2u, 0x46dbu},
                   {3, 0xdb8766u, 0xc98766u}};
    size_t count = qemu_plugin_tb_n_insns(block);
    for (size_t i = 0; i < count; i++) {
        struct qemu_plugin_insn *insn = qemu_plugin_tb_get_insn(block, i);
        size_t size = qemu_plugin_insn_size(insn);
        uint32_t code = 0;
        memcpy(&code, qemu_plugin_insn_data(insn), size < 4 ? size : 4);
        for (size_t m = 0; m < sizeof markers / sizeof markers[0]; m++) {
            if (size == markers[m].size && code == markers[m].start) {
                qemu_plugin_register_vcpu_insn_exec_cb(insn, on_start, CALLBACK_READS_NO_REGISTERS, NULL);
            }
            if (size == markers[m].size && code == markers[m].stop) {
                qemu_plugin_register_vcpu_insn_exec_cb(insn, on_stop, CALLBACK_READS_NO_REGISTERS, NULL);
            }
        }
        qemu_plugin_register_vcpu_insn_exec_inline(insn, INLINE_ADD_U64, &executed, 1);
    }
}

int qemu_plugin_install(uint64_t id, const qemu_info *info, int argc, char **argv)
{
    (void)info;
    out = stderr;
    for (int i = 0; i < argc; i++) {
        if (strncmp(argv[i], "out=", 4) == 0) {
            out = fopen(argv[i] + 4, "w");
        }
    }
    if (!out) {
        return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
    return 0;
}
