export default {
  serverExternalPackages: ["strut-motion"],
};
