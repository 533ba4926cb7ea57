#include "client/diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <memory>

#include "client/certificate.h"

namespace rollgait::client {
namespace {

using Level = Finding::Level;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int64_t kStart_s = 1764028800;  // 2025-11-25 00:00:00 UTC
constexpr int64_t kDay_s = 86400;

// A self-signed certificate for gait.example and 127.0.0.1, valid for 100 days.
std::string SamplePem() {
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  const std::unique_ptr<X509, decltype(&X509_free)> x509(X509_new(), X509_free);
  X509_set_version(x509.get(), 2);
  ASN1_TIME_set(X509_getm_notBefore(x509.get()), kStart_s);
  ASN1_TIME_set(X509_getm_notAfter(x509.get()), kStart_s + 100 * kDay_s);
  X509_NAME_add_entry_by_txt(X509_get_subject_name(x509.get()), "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>("gait server"), -1, -1, 0);
  const std::unique_ptr<X509_EXTENSION, decltype(&X509_EXTENSION_free)> names(
      X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, "DNS:gait.example,DNS:*.lab.example,IP:127.0.0.1"),
      X509_EXTENSION_free);
  X509_add_ext(x509.get(), names.get(), -1);
  X509_set_pubkey(x509.get(), key.get());
  X509_sign(x509.get(), key.get(), EVP_sha256());
  const std::unique_ptr<BIO, decltype(&BIO_free)> bio(BIO_new(BIO_s_mem()), BIO_free);
  PEM_write_bio_X509(bio.get(), x509.get());
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<size_t>(size)};
}

TEST(CertificateTest, SaysNamesAndDates) {
  const std::optional<Certificate> certificate = ReadCertificate(SamplePem());
  ASSERT_TRUE(certificate);
  EXPECT_EQ(certificate->subject, "gait server");
  EXPECT_THAT(certificate->names, ElementsAre("gait.example", "*.lab.example", "127.0.0.1"));
  EXPECT_EQ(certificate->not_before_s, kStart_s);
  EXPECT_EQ(certificate->not_after_s, kStart_s + 100 * kDay_s);
  EXPECT_FALSE(ReadCertificate("-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n"));
  EXPECT_FALSE(ReadCertificate(""));
}

TEST(CertificateTest, IsForItsNamesOnly) {
  for (const char* host : {"gait.example", "a.lab.example", "127.0.0.1"}) {
    EXPECT_TRUE(IsCertificateFor(SamplePem(), host)) << host;
  }
  for (const char* host : {"gait server", "other.example", "127.0.0.2", "a.b.lab.example"}) {
    EXPECT_FALSE(IsCertificateFor(SamplePem(), host)) << host;
  }
}

TEST(DiagnosisTest, CertificatesAreJudgedByDateAndName) {
  const std::string pem = SamplePem();
  const auto judge = [&](const char* host, int64_t day) {
    return JudgeCertificate("server certificate", pem, host, kStart_s + day * kDay_s).level;
  };
  EXPECT_EQ(judge("gait.example", 1), Level::kOk);
  EXPECT_EQ(judge("", 1), Level::kOk);
  EXPECT_EQ(judge("gait.example", 87), Level::kWarn);
  EXPECT_EQ(judge("gait.example", 101), Level::kFail);
  EXPECT_EQ(judge("gait.example", -1), Level::kFail);
  EXPECT_EQ(judge("other.example", 1), Level::kFail);
  EXPECT_EQ(JudgeCertificate("file", "no PEM", "", kStart_s).level, Level::kFail);
  EXPECT_THAT(JudgeCertificate("file", pem, "", kStart_s).text, HasSubstr("2025-11-25 00:00:00 UTC"));
}

TEST(DiagnosisTest, Versions) {
  v1::ServerInfo info;
  info.set_version("0.4.2");
  EXPECT_EQ(JudgeVersion("0.4.0", info).level, Level::kOk);
  EXPECT_EQ(JudgeVersion("0.5.0", info).level, Level::kWarn);
  EXPECT_EQ(JudgeVersion("1.4.2", info).level, Level::kWarn);
}

TEST(DiagnosisTest, ClocksMayDifferByWhatTheCallTook) {
  v1::ServerInfo info;
  EXPECT_EQ(JudgeClock(info, 0, 0).level, Level::kOk);  // an old server
  info.mutable_server_time()->set_seconds(1000);
  EXPECT_EQ(JudgeClock(info, 999, 1001).level, Level::kOk);
  EXPECT_EQ(JudgeClock(info, 990, 1004).level, Level::kOk);  // 3 s, but the call took 14
  EXPECT_EQ(JudgeClock(info, 996, 996.5).level, Level::kWarn);
  EXPECT_THAT(JudgeClock(info, 996, 996).text, HasSubstr("4 s ahead of ours"));
  EXPECT_THAT(JudgeClock(info, 1010, 1010).text, HasSubstr("10 s behind ours"));
}

TEST(DiagnosisTest, QueueAndDisk) {
  v1::ServerInfo info;
  EXPECT_THAT(JudgeQueue(info).text, HasSubstr("0 solves run on agents elsewhere, 0 solves wait"));
  info.set_solver_slots(2);
  info.set_max_queued(10);
  EXPECT_EQ(JudgeQueue(info).level, Level::kOk);
  info.set_queued(8);
  EXPECT_EQ(JudgeQueue(info).level, Level::kWarn);
  info.set_queued(10);
  EXPECT_EQ(JudgeQueue(info).level, Level::kFail);
  EXPECT_EQ(JudgeDisk(info).level, Level::kOk);  // not told
  info.set_store_free_bytes(int64_t{2} << 30);
  EXPECT_EQ(JudgeDisk(info).level, Level::kOk);
  info.set_store_free_bytes(int64_t{500} << 20);
  EXPECT_EQ(JudgeDisk(info).level, Level::kWarn);
  info.set_store_free_bytes(int64_t{10} << 20);
  EXPECT_EQ(JudgeDisk(info).level, Level::kFail);
}

TEST(DiagnosisTest, CallersThatCannotSolveAreWarned) {
  v1::ServerInfo info;
  EXPECT_EQ(JudgeCaller(info).level, Level::kOk);
  info.mutable_caller()->set_authentication(v1::Caller::AUTHENTICATION_TOKEN);
  info.mutable_caller()->add_scopes("read");
  EXPECT_EQ(JudgeCaller(info).level, Level::kWarn);
  info.mutable_caller()->add_scopes("solve");
  EXPECT_EQ(JudgeCaller(info).level, Level::kOk);
}

}  // namespace
}  // namespace rollgait::client
