#include "team_link.h"

#include <string.h>

#include "../args.h"
#include "../complain.h"

/* Copies what stands before `end`; 1 when it fits and is not empty. */
static int copy_part(char *to, size_t capacity, const char *from, const char *end)
{
    const size_t length = (size_t)(end - from);
    if (length < 1 || length >= capacity) {
        return 0;
    }
    memcpy(to, from, length);
    to[length] = '\0';
    return 1;
}

static int is_port(int32_t *port, const char *text)
{
    return args_numbers(port, 1, ',', text) && *port >= 1 && *port <= 65535;
}

/* [:GROUP:PORT[,INTERFACE]] */
static int read_udp(team_link_option *option, const char *text)
{
    char number[8];
    if (*text == '\0') {
        return 1;
    }
    const char *colon = *text == ':' ? strchr(text + 1, ':') : NULL;
    if (!colon || !copy_part(option->host, sizeof option->host, text + 1, colon)) {
        return 0;
    }
    const char *comma = strchr(colon, ','), *end = comma ? comma : colon + strlen(colon);
    return copy_part(number, sizeof number, colon + 1, end) && is_port(&option->port, number) &&
           (!comma || copy_part(option->face, sizeof option->face, comma + 1, comma + strlen(comma)));
}

/* HOST[:PORT][/TOPIC] */
static int read_mqtt(team_link_option *option, const char *text)
{
    char number[8];
    const char *slash = strchr(text, '/'), *end = slash ? slash : text + strlen(text);
    const char *colon = memchr(text, ':', (size_t)(end - text));
    if (!copy_part(option->host, sizeof option->host, text, colon ? colon : end) ||
        (colon && !(copy_part(number, sizeof number, colon + 1, end) && is_port(&option->port, number)))) {
        return 0;
    }
    return !slash || copy_part(option->topic, sizeof option->topic, slash + 1, slash + strlen(slash));
}

int team_link_read(team_link_option *option, const char *text)
{
    static const char scheme[] = "mqtt://";
    text = text ? text : "udp";
    *option = (team_link_option){0, IRIS_UDP_PORT, IRIS_UDP_GROUP, "iris", ""};
    int good = 0;
    if (strncmp(text, scheme, sizeof scheme - 1) == 0) {
        option->is_mqtt = 1;
        option->port = IRIS_MQTT_PORT;
        good = read_mqtt(option, text + sizeof scheme - 1);
    } else if (strncmp(text, "udp", 3) == 0) {
        good = read_udp(option, text + 3);
    }
    if (!good) {
        complain("--transport", "'%s' is neither udp[:GROUP:PORT[,INTERFACE]] nor mqtt://HOST[:PORT][/TOPIC]",
                 text);
    }
    return good;
}

static int open_udp(team_link *link)
{
    const team_link_option *option = &link->option;
    const iris_status status =
        iris_udp_open(&link->udp, option->host, option->port, option->face[0] ? option->face : NULL);
    if (status == IRIS_ERR_ARG || status == IRIS_ERR_RANGE) {
        complain("--transport", "%s is no group for multicast: 224.0.0.0 to 239.255.255.255", option->host);
        return 0;
    }
    if (status != IRIS_OK) {
        complain("--transport", "%s", iris_udp_error(&link->udp));
        return 0;
    }
    return iris_udp_transport(&link->transport, &link->udp) == IRIS_OK;
}

static int open_mqtt(team_link *link, const uint8_t *will, size_t count, int32_t kept)
{
    const team_link_option *option = &link->option;
    iris_mqtt_config config;
    iris_mqtt_defaults(&config);
    config.host = option->host;
    config.port = option->port;
    config.topic = option->topic;
    config.will = count > 0 ? will : NULL;
    config.will_count = count;
    config.kept = kept;
    const iris_status status = iris_mqtt_open(&link->mqtt, &config);
    if (status == IRIS_ERR_ARG) {
        complain("--transport", "'%s' cannot be a topic: letters, digits, and / between them", option->topic);
        return 0;
    }
    if (status == IRIS_ERR_UNSUPPORTED) {
        complain("--transport", "%s", iris_mqtt_problem(&link->mqtt));
        return 0;
    }
    return iris_mqtt_transport(&link->transport, &link->mqtt) == IRIS_OK;
}

int team_link_open(team_link *link, const team_link_option *option, const uint8_t *will, size_t count,
                   int32_t kept)
{
    memset(link, 0, sizeof *link);
    link->option = *option;
    return option->is_mqtt ? open_mqtt(link, will, count, kept) : open_udp(link);
}

void team_link_close(team_link *link)
{
    iris_udp_close(&link->udp);
    iris_mqtt_close(&link->mqtt);
}
