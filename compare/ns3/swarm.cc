// How a swarm's broadcasts fare in ns-3's lr-wpan, on a given topology; and random topologies.
//
//   swarm topology SHAPE N SEED                            prints a topology
//   swarm run PAYLOAD SECONDS random|synchronous RUN FILE ...  prints a row for each topology
//
// Each node asks for one broadcast a second, at its phase or at the full second, and all that the
// MAC and PHY then do is ns-3's own: unslotted CSMA/CA, no acknowledgement, short addresses, channel
// 11, 0 dBm, log-distance loss with ns-3's defaults, and the propagation delay that ns-3's own
// lr-wpan examples use. Counted is at the MAC's and PHY's public callbacks and traces.

#include <ns3/constant-position-mobility-model.h>
#include <ns3/core-module.h>
#include <ns3/lr-wpan-module.h>
#include <ns3/network-module.h>
#include <ns3/propagation-delay-model.h>
#include <ns3/propagation-loss-model.h>
#include <ns3/single-model-spectrum-channel.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

using namespace ns3;

namespace
{

[[noreturn]] void
Fail(const std::string& why)
{
    std::cerr << "error: " << why << std::endl;
    std::exit(2);
}

struct Place
{
    double x, y, z, phase;
};

// ---------------------------------------------------------------------------- topologies

/// Uniform in [0, 1), the same on every machine.
class Chance
{
  public:
    explicit Chance(uint64_t seed)
        : m_engine(seed)
    {
    }

    double Unit()
    {
        return static_cast<double>(m_engine() >> 11) / 9007199254740992.0;
    }

    double In(double low, double high)
    {
        return low + (high - low) * Unit();
    }

    Place Ball(double radius, double east)
    {
        for (;;)
        {
            Place p{In(-radius, radius), In(-radius, radius), In(-radius, radius), 0};
            if (p.x * p.x + p.y * p.y + p.z * p.z <= radius * radius)
            {
                p.x += east;
                return p;
            }
        }
    }

  private:
    std::mt19937_64 m_engine;
};

Place
Draw(const std::string& shape, uint32_t node, Chance& chance)
{
    if (shape == "ball") // everybody hears everybody
    {
        return chance.Ball(20, 0);
    }
    if (shape == "clusters") // the outer two are deaf to each other, the middle one hears both
    {
        const double east[] = {-75, 75, 0};
        return chance.Ball(10, east[node % 3]);
    }
    if (shape == "pair") // two groups at the edge of each other's noise
    {
        return chance.Ball(10, node % 2 == 0 ? -75 : 75);
    }
    if (shape == "line")
    {
        return {chance.In(0, 300), 0, 10, 0};
    }
    if (shape == "plane")
    {
        return {chance.In(0, 200), chance.In(0, 200), 10, 0};
    }
    Fail("no shape called " + shape + ": there are ball, clusters, pair, line and plane");
}

void
PrintTopology(const std::string& shape, uint32_t n, uint64_t seed)
{
    Chance chance(seed * 1000003 + n);
    std::printf("node,x_m,y_m,z_m,phase_s\n");
    for (uint32_t node = 0; node < n; ++node)
    {
        Place p = Draw(shape, node, chance);
        std::printf("%u,%.6f,%.6f,%.6f,%.6f\n", node, p.x, p.y, p.z, std::floor(chance.Unit() * 1e6) / 1e6);
    }
}

std::vector<Place>
ReadTopology(const std::string& path)
{
    std::ifstream file(path);
    if (!file)
    {
        Fail("cannot read " + path);
    }
    std::vector<Place> places;
    std::string line;
    bool head = true;
    while (std::getline(file, line))
    {
        if (line.empty() || line[0] == '#')
        {
            continue;
        }
        if (head)
        {
            if (line != "node,x_m,y_m,z_m,phase_s")
            {
                Fail(path + ": the header is node,x_m,y_m,z_m,phase_s");
            }
            head = false;
            continue;
        }
        Place p{};
        unsigned node = 0;
        if (std::sscanf(line.c_str(), "%u,%lf,%lf,%lf,%lf", &node, &p.x, &p.y, &p.z, &p.phase) != 5)
        {
            Fail(path + ": " + line);
        }
        places.push_back(p);
    }
    return places;
}

// ---------------------------------------------------------------------------- a run

struct Count
{
    uint64_t requests{0};
    uint64_t failures{0};
    uint64_t transmitted{0};
    uint64_t begun{0};
    uint64_t delivered{0};
    double delayMs{0};
};

Count g_count;

/// One node's MAC, and when its waiting frames were asked for.
struct Sender
{
    Ptr<LrWpanNetDevice> device;
    std::deque<Time> waiting;
    uint32_t payload{0};

    void Ask()
    {
        McpsDataRequestParams params;
        params.m_srcAddrMode = SHORT_ADDR;
        params.m_dstAddrMode = SHORT_ADDR;
        params.m_dstPanId = 1;
        params.m_dstAddr = Mac16Address("ff:ff");
        ++g_count.requests;
        waiting.push_back(Simulator::Now());
        device->GetMac()->McpsDataRequest(params, Create<Packet>(payload));
    }

    void Begin(Ptr<const Packet>)
    {
        ++g_count.transmitted;
        g_count.delayMs += (Simulator::Now() - waiting.front()).GetSeconds() * 1e3;
        waiting.pop_front();
    }

    void Confirm(McpsDataConfirmParams params)
    {
        if (params.m_status == IEEE_802_15_4_CHANNEL_ACCESS_FAILURE)
        {
            ++g_count.failures;
            waiting.pop_front();
        }
        else if (params.m_status != IEEE_802_15_4_SUCCESS)
        {
            Fail("a request ended with status " + std::to_string(params.m_status));
        }
    }
};

void
Indication(McpsDataIndicationParams, Ptr<Packet>)
{
    ++g_count.delivered;
}

void
RxBegin(Ptr<const Packet>)
{
    ++g_count.begun;
}

std::string
Name(const std::string& path)
{
    std::string name = path.substr(path.find_last_of('/') + 1);
    return name.substr(0, name.rfind(".csv"));
}

void
Run(const std::string& path, uint32_t payload, uint32_t seconds, bool synchronous, uint32_t run)
{
    g_count = Count();
    RngSeedManager::SetSeed(1);
    RngSeedManager::SetRun(run);
    const std::vector<Place> places = ReadTopology(path);
    const uint32_t n = places.size();

    Ptr<SingleModelSpectrumChannel> channel = CreateObject<SingleModelSpectrumChannel>();
    channel->AddPropagationLossModel(CreateObject<LogDistancePropagationLossModel>());
    channel->SetPropagationDelayModel(CreateObject<ConstantSpeedPropagationDelayModel>());

    std::vector<Sender> senders(n);
    for (uint32_t i = 0; i < n; ++i)
    {
        Ptr<Node> node = CreateObject<Node>();
        Ptr<LrWpanNetDevice> device = CreateObject<LrWpanNetDevice>();
        device->SetChannel(channel);
        node->AddDevice(device);
        const uint8_t address[] = {static_cast<uint8_t>((i + 1) >> 8), static_cast<uint8_t>(i + 1)};
        Mac16Address own;
        own.CopyFrom(address);
        device->GetMac()->SetShortAddress(own);
        device->GetMac()->SetPanId(1);
        Ptr<ConstantPositionMobilityModel> place = CreateObject<ConstantPositionMobilityModel>();
        place->SetPosition(Vector(places[i].x, places[i].y, places[i].z));
        node->AggregateObject(place);
        device->GetPhy()->SetMobility(place);

        Sender& sender = senders[i];
        sender.device = device;
        sender.payload = payload;
        device->GetMac()->SetMcpsDataIndicationCallback(MakeCallback(&Indication));
        device->GetMac()->SetMcpsDataConfirmCallback(MakeCallback(&Sender::Confirm, &sender));
        device->GetPhy()->TraceConnectWithoutContext("PhyTxBegin", MakeCallback(&Sender::Begin, &sender));
        device->GetPhy()->TraceConnectWithoutContext("PhyRxBegin", MakeCallback(&RxBegin));
        const Time phase = NanoSeconds(synchronous ? 0 : std::llround(places[i].phase * 1e9));
        for (uint32_t k = 0; k < seconds; ++k)
        {
            Simulator::ScheduleWithContext(node->GetId(), Seconds(k) + phase, &Sender::Ask, &sender);
        }
    }
    Simulator::Run();
    for (const Sender& sender : senders)
    {
        if (!sender.waiting.empty())
        {
            Fail(path + ": a frame was neither sent nor given up");
        }
    }
    Simulator::Destroy();

    const Count& c = g_count;
    std::printf("%s,%u,%u,%s,%u,%u,%llu,%llu,%llu,%llu,%llu,%.6f,%.5f\n",
                Name(path).c_str(),
                n,
                payload,
                synchronous ? "synchronous" : "random",
                seconds,
                run,
                static_cast<unsigned long long>(c.requests),
                static_cast<unsigned long long>(c.failures),
                static_cast<unsigned long long>(c.transmitted),
                static_cast<unsigned long long>(c.begun),
                static_cast<unsigned long long>(c.delivered),
                static_cast<double>(c.delivered) / (static_cast<double>(c.transmitted) * (n - 1)),
                c.delayMs / static_cast<double>(c.transmitted));
    std::fflush(stdout);
}

uint64_t
Number(const std::string& text)
{
    std::istringstream in(text);
    uint64_t number = 0;
    if (!(in >> number) || !in.eof())
    {
        Fail(text + " is no number");
    }
    return number;
}

} // namespace

int
main(int argc, char** argv)
{
    const std::vector<std::string> a(argv + 1, argv + argc);
    if (a.size() == 4 && a[0] == "topology")
    {
        PrintTopology(a[1], Number(a[2]), Number(a[3]));
    }
    else if (a.size() >= 6 && a[0] == "run" && (a[3] == "random" || a[3] == "synchronous"))
    {
        for (size_t i = 5; i < a.size(); ++i)
        {
            Run(a[i], Number(a[1]), Number(a[2]), a[3] == "synchronous", Number(a[4]));
        }
    }
    else
    {
        Fail("swarm topology SHAPE N SEED | swarm run PAYLOAD SECONDS random|synchronous RUN FILE ...");
    }
    return 0;
}
